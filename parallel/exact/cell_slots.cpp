#include "parallel/exact/cell_slots.hpp"

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

template <class T>
void refill(std::vector<T>& column, std::size_t n, T value) {
  if (column.capacity() < n) resize_in_huge_pages(column, n);
  column.assign(n, value);
}

}  // namespace

void CellSlots::begin(std::uint32_t cells, std::size_t disks, bool unequal_radii) {
  const std::size_t slots = std::size_t{cells} * slots_a_cell;
  refill(position_, slots, FixedPointPosition{});
  refill(disk_, slots, none);
  refill(radius_, unequal_radii ? slots : 0, 0.0F);
  refill(chain_, cells, none);
  refill(cell_, disks, none);
  refill(next_, disks, none);
}

void CellSlots::insert(std::uint32_t cell, std::uint32_t disk, FixedPointPosition position, float radius) {
  cell_[disk] = cell;
  const std::uint32_t first = cell * slots_a_cell;
  for (std::uint32_t s = first; s < first + slots_a_cell; ++s) {
    if (disk_[s] != none) continue;
    disk_[s] = disk;
    position_[s] = position;
    if (!radius_.empty()) radius_[s] = radius;
    return;
  }
  next_[disk] = chain_[cell];
  chain_[cell] = disk;
}

}  // namespace carom
