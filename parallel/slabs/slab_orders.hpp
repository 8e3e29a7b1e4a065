// psi6 of the disks of all ranks, none of which has all disks.
#pragma once

#include <optional>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// As with_orders, for those of this rank's disks that the plan measures. Nothing, on all ranks, if a disk's six
// neighbours may belong to ranks that are not neighbours. box: at the time of the disks. run: on the threads of this
// rank. Collective.
std::optional<Disks> orders_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box, const Disks& own,
                                       const SlabCut& cut, const BlockRunner& run = run_in_order);

// The first search distance for neighbours among this number of disks; length.
double first_reach(const Domain& box, Count disks);

}  // namespace carom
