#include "core/measure/measured_disks.hpp"

#include "core/disks/disk_columns.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/shear_flow.hpp"

namespace carom {

Disks disks_of(const Disks& all, const IdRange& ids) {
  Disks some = no_disks_like(all);
  const DiskColumns columns = columns_of(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (ids.holds(all.id[i])) push_back(some, disk_at(all, i), columns);
  }
  return some;
}

DisksOfGroup::DisksOfGroup(const DisksInPieces& all, const std::optional<IdRange>& ids)
    : all_(all), ids_(ids), size_(ids ? 0 : all.size()) {
  if (ids) all.visit([&](const Disks& some) { size_ += disks_of(some, *ids).size(); });
}

void DisksOfGroup::visit(const Use& use) const {
  if (!ids_) return all_.visit(use);
  all_.visit([&](const Disks& some) { use(disks_of(some, *ids_)); });
}

const Disks& DisksOfGroup::whole() const {
  if (!ids_) return all_.whole();
  if (!whole_) whole_ = disks_of(all_.whole(), *ids_);
  return *whole_;
}

void DisksInFlow::visit(const Use& use) const {
  if (!box_.shear.acts()) return disks_.visit(use);
  disks_.visit([&](const Disks& some) { use(relative_to_flow(some, box_)); });
}

const Disks& DisksInFlow::whole() const {
  if (!box_.shear.acts()) return disks_.whole();
  if (!whole_) whole_ = relative_to_flow(disks_.whole(), box_);
  return *whole_;
}

void DisksWithOrders::visit(const Use& use) const {
  if (!all_.visit_orders(use)) use(whole());
}

const Disks& DisksWithOrders::whole() const {
  if (!whole_) whole_ = with_orders(disks_.whole(), bond_orders(disks_.whole(), box_, run_));
  return *whole_;
}

}  // namespace carom
