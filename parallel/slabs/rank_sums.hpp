// Sums and figures of a step, or of a state, over all ranks.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/step/validity.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom {

// The tally becomes the sum over all ranks, which is exact and so the same in any order of addition.
void sum_over_ranks(Ranks& ranks, const Domain& box, ImpactTally& tally);

// Adds the disks taken by sinks on each rank to `all`, which has an entry for each sink.
void count_taken_on_ranks(Ranks& ranks, SinkCounts taken, SinkCounts& all);

// The overlaps become the deepest of all ranks; counts stay.
void join_over_ranks(Ranks& ranks, StepFigures& figures);

// count[k] becomes the sum over all ranks; ranks may have fewer classes than others.
void sum_counts_over_ranks(Ranks& ranks, std::vector<std::size_t>& count);

}  // namespace carom
