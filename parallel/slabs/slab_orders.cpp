#include "parallel/slabs/slab_orders.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/measure/bond_order.hpp"
#include "core/measure/measured_disks.hpp"
#include "parallel/slabs/border_disks.hpp"
#include "parallel/slabs/moving_disks.hpp"

namespace carom {

// In a liquid the nearest six disks are within two mean distances.
double first_reach(const Domain& box, Count disks) {
  return 3.0 * std::sqrt(box.width * box.height / static_cast<double>(disks));
}

// The search distance is doubled as long as a disk of any rank has too few neighbours.
std::optional<Disks> orders_over_ranks(Ranks& ranks, const AnalysisPlan& plan, const Domain& box, const Disks& all,
                                       const SlabCut& cut, const BlockRunner& run) {
  const Disks some = plan.group.empty() ? Disks{} : disks_of(all, plan.ids);
  const Disks& own = plan.group.empty() ? all : some;
  auto count = static_cast<std::int64_t>(own.size());
  ranks.sum({&count, 1});
  const auto disks = static_cast<Count>(count);
  if (disks < least_of_bonds) return with_orders(own, {});
  if (ranks.count() == 1) return with_orders(own, bond_orders(own, box, run));
  const Slab slab = slab_of(cut, box, ranks.rank());
  const double excursion = excursion_over_ranks(ranks, slab, box, own);
  for (double reach = first_reach(box, disks);; reach *= 2.0) {
    if (ranks.count() > 2 && !is_within_neighbours(cut, box, reach, excursion)) return std::nullopt;
    Disks around = joined(own, disks_at_borders(ranks, slab, box, own, reach, excursion).others);
    const auto orders = bond_orders_of_first(around, own.size(), box, reach, run);
    if (ranks.any(!orders.has_value())) continue;
    truncate(around, own.size());
    return with_orders(std::move(around), *orders);
  }
}

}  // namespace carom
