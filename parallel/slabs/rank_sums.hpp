// Figures of a step, or of a state, that all ranks together make.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/physics/impact_tally.hpp"
#include "core/step/validity.hpp"
#include "parallel/ranks/ranks.hpp"

namespace carom {

// The tally becomes that of all ranks: exact, thus the same in whatever order they are added.
void sum_over_ranks(Ranks& ranks, const Domain& box, ImpactTally& tally);

// Adds what the sinks took on each rank to `all`, which has an entry for each sink.
void count_taken_on_ranks(Ranks& ranks, SinkCounts taken, SinkCounts& all);

// The overlaps become the deepest of all ranks'; counts stay.
void join_over_ranks(Ranks& ranks, StepFigures& figures);

// count[k] becomes that of all ranks; ranks may have fewer classes than others.
void sum_counts_over_ranks(Ranks& ranks, std::vector<std::size_t>& count);

}  // namespace carom
