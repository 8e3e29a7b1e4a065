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

void CellSlots::begin(std::uint32_t cells, std::uint32_t cells_a_part, bool unequal_radii) {
  const std::size_t slots = std::size_t{cells} * slots_a_cell;
  refill(position_, slots, SlotPosition{});
  refill(disk_, slots, none);
  refill(radius_, unequal_radii ? slots : 0, 0.0F);
  refill(chain_, cells, none);
  cells_a_part_ = cells_a_part;
  links_.resize(cells / cells_a_part + 1);
  for (PartLinks& part : links_) {
    part.link.clear();
    part.free = none;
  }
}

void CellSlots::insert(std::uint32_t cell, std::uint32_t disk, SlotPosition position, float radius) {
  const std::uint32_t first = cell * slots_a_cell;
  for (std::uint32_t s = first; s < first + slots_a_cell; ++s) {
    if (disk_[s] != none) continue;
    disk_[s] = disk;
    position_[s] = position;
    if (!radius_.empty()) radius_[s] = radius;
    return;
  }
  PartLinks& part = links_of(cell);
  std::uint32_t fresh = part.free;
  if (fresh != none) {
    part.free = part.link[fresh].next;
  } else {
    fresh = static_cast<std::uint32_t>(part.link.size());
    part.link.emplace_back();
  }
  part.link[fresh] = {disk, chain_[cell]};
  chain_[cell] = fresh;
}

void CellSlots::remove(std::uint32_t cell, std::uint32_t disk) {
  const std::uint32_t first = cell * slots_a_cell;
  for (std::uint32_t s = first; s < first + slots_a_cell; ++s) {
    if (disk_[s] != disk) continue;
    disk_[s] = none;
    return;
  }
  PartLinks& part = links_of(cell);
  std::uint32_t* link = &chain_[cell];
  while (part.link[*link].disk != disk) link = &part.link[*link].next;
  const std::uint32_t out = *link;
  *link = part.link[out].next;
  part.link[out].next = part.free;
  part.free = out;
}

}  // namespace carom
