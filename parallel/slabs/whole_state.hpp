// What is said of the disks of all ranks together, while each has its own alone. All calls are collective.
#pragma once

#include <functional>

#include "core/disks/state.hpp"
#include "core/measure/state_sums.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// Calls use(some) on rank 0 for the disks of all ranks in order of id, some ten thousand at a time, with a radius and a
// mass each.
void visit_in_id_order(Ranks& ranks, const State& part, const std::function<void(const Disks&)>& use);

// part: a state with the rank's own disks. The result is that of all disks, bit for bit; of the sums, on rank 0 alone.
StateSums sums_over_ranks(Ranks& ranks, const Scene& scene, const State& part);

// cut: the slabs that the disks are in, or have not left by more than half of the thinnest.
DeepestOverlaps overlaps_over_ranks(Ranks& ranks, const Scene& scene, const State& part, const SlabCut& cut);

// The same of two disks alone: those that a rank has in that box, which may be of a moment within the last step.
Overlap overlap_over_ranks(Ranks& ranks, const Domain& box, const Disks& own, const SlabCut& cut);

}  // namespace carom
