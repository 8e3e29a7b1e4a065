// Figures of the disks of all ranks together, each of which has only its own. All calls are collective.
#pragma once

#include <functional>

#include "core/disks/state.hpp"
#include "core/measure/state_sums.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// Calls use(some) on rank 0 for the disks of all ranks in order of id, some ten thousand at a time, each with a radius
// and a mass.
void visit_in_id_order(Ranks& ranks, const State& part, const std::function<void(const Disks&)>& use);

// Sums over the disks of all ranks, bit for bit as on one machine; on rank 0. part: a state with the rank's own disks.
StateSums sums_over_ranks(Ranks& ranks, const Scene& scene, const State& part);

// cut: the slabs that the disks are in, or have left by at most half of the thinnest.
DeepestOverlaps overlaps_over_ranks(Ranks& ranks, const Scene& scene, const State& part, const SlabCut& cut);

// The same only for two disks, of own disks in that box, which may be those of a moment within the last step.
Overlap overlap_over_ranks(Ranks& ranks, const Domain& box, const Disks& own, const SlabCut& cut);

}  // namespace carom
