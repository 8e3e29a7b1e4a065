// Pairs by distance of the disks of all ranks, none of which has all disks.
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

// The result of pairs_of_plan for all disks. Nothing if the plan has no pairs, or if slabs are so thin that a pair may
// belong to two ranks that are not neighbours. box: at the time of the disks. run: on the threads of this rank.
// Collective.
std::optional<std::vector<PairCounts>> pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                                        const Disks& own, const SlabCut& cut, const BlockRunner& run);

// The same for bond_pairs, if the plan has the bond correlation and there are at least seven disks. orders: of this
// rank (slab_orders.hpp).
std::optional<BondPairs> bond_pairs_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box,
                                               const Disks& orders, const SlabCut& cut, const BlockRunner& run);

}  // namespace carom
