// Pairs by distance of the disks of all ranks, of which none has all.
#pragma once

#include <optional>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair_counts.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// What pairs_of_plan finds among all disks. Absent where the plan asks for no pairs, and where slabs are so thin that a
// pair may be of two ranks that are no neighbours. box: at the time of the disks. run: on the threads of this rank.
// Collective.
std::optional<std::vector<PairCounts>> pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                                        const Disks& own, const SlabCut& cut, const BlockRunner& run);

// The same of bond_pairs, where the plan asks for the bond correlation and there are seven disks or more. orders: of
// this rank (slab_orders.hpp).
std::optional<BondPairs> bond_pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                               const Disks& orders, const SlabCut& cut, const BlockRunner& run);

}  // namespace carom
