// psi6 of the disks of all ranks, of which none has all.
#pragma once

#include <optional>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// This rank's disks, as with_orders: those that the plan measures. Absent, on all ranks, where a disk's six neighbours
// may be of ranks that are no neighbours. box: at the time of the disks. run: on the threads of this rank. Collective.
std::optional<Disks> orders_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box, const Disks& own,
                                       const SlabCut& cut, const BlockRunner& run = run_in_order);

// How far neighbours are looked for at first, with so many disks; length.
double first_reach(const Domain& box, Count disks);

}  // namespace carom
