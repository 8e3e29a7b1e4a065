// The cells of the neighbour lists: the cell of a listed position, and how disks are put into cells.
#include <algorithm>
#include <cmath>

#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

namespace {

// A generous factor for what rounding and slots add to the reach of lists.
constexpr double slot_room = 1.1;
// In skins.
constexpr double coarse_unit = 1.0 / 32.0;
// More than single precision adds to the reach of a list, as a share of it.
constexpr double search_rounding = 4e-5;

}  // namespace

// Differences of two places that are listed together must not wrap round in a slot. Differences of all places that one
// search reads should not either, unless units would be coarse then; if they do, a few disks too many may be listed. A
// period has at least as many bits as a slot, so differences wrap round the box as they do with all bits.
void NeighbourLists::choose_slot_units() {
  const double listed = flow_.stretch * (2.0 * largest_radius_ + 2.0 * skin_) * slot_room;
  double cell_width = 0.0;
  double cell_height = 0.0;
  for (const GridLevel& level : grid_.levels) {
    cell_width = std::max(cell_width, level.cell_width);
    cell_height = std::max(cell_height, level.cell_height);
  }
  const auto shift = [&](double unit, double cell) {
    const auto unit_of = [unit](unsigned bits) { return std::ldexp(unit, static_cast<int>(bits)); };
    const auto reach_of = [&](unsigned bits) { return 0x1p15 * unit_of(bits); };
    unsigned bits = 0;
    while (bits < 16U &&
           (reach_of(bits) < listed || (reach_of(bits) < listed + cell && unit_of(bits + 1) < coarse_unit * skin_))) {
      ++bits;
    }
    return bits;
  };
  slot_shift_x_ = shift(listed_box_.unit.x, cell_width);
  slot_shift_y_ = shift(listed_box_.unit.y, cell_height);
  slot_unit_x_ = std::ldexp(listed_box_.unit.x, static_cast<int>(slot_shift_x_));
  slot_unit_y_ = std::ldexp(listed_box_.unit.y, static_cast<int>(slot_shift_y_));
  const double unit = std::max(slot_unit_x_, slot_unit_y_);
  slots_per_length_ = 1.0 / unit;
  search_margin_ = 2.0 * (slot_unit_x_ + slot_unit_y_) + 2.0 * list_kernel_rounding * unit + search_rounding * listed;
}

// Puts the disks that are sorted into cells [first_key, last_key) into the slots of the cells of their listed
// positions, which are the same cells except in a shear.
void NeighbourLists::fill_slots(const Disks& d, std::uint32_t first_key, std::uint32_t last_key) {
  for (std::uint32_t key = first_key; key < last_key; ++key) {
    for (std::uint32_t i = cells_.start[key]; i < cells_.start[key + 1]; ++i) {
      if (!flow_.acts) move_into_cell(d, i, key);
      fill_slot(d, i);
    }
  }
}

void NeighbourLists::fill_slot(const Disks& d, std::uint32_t i) {
  const FixedPointPosition at = rows_.listed_at(i);
  slots_.insert(cell_in(level_of(d, i), at), i, slot_position(at), radius_in_units(d.radius_of(i)));
}

// By rounding the listed position may be in the cell next to the one into which the disk is sorted: then the position
// is moved by one unit.
void NeighbourLists::move_into_cell(const Disks& d, std::uint32_t i, std::uint32_t key) {
  constexpr std::uint32_t shifts[] = {0U, 1U, 0U - 1U};
  const std::size_t level = level_of(d, i);
  const FixedPointPosition rounded = rows_.listed_at(i);
  for (const std::uint32_t dy : shifts) {
    for (const std::uint32_t dx : shifts) {
      const FixedPointPosition shifted{rounded.x + dx, rounded.y + dy};
      if (cell_in(level, shifted) == key) return rows_.set_listed_at(i, shifted);
    }
  }
}

std::size_t NeighbourLists::level_of(const Disks& d, std::uint32_t i) const {
  if (d.radius.empty()) return 0;
  return growth_ > 0.0 ? kept_level_[i] : level_of_radius(d.radius[i]);
}

// A disk that was added later may be smaller than those that the grid was made for.
std::size_t NeighbourLists::level_of_radius(double radius) const {
  return std::min(class_of_radius(radius, grid_.levels.front().largest_radius), grid_.levels.size() - 1);
}

void NeighbourLists::keep_levels(const Disks& d) {
  kept_level_.clear();
  if (mode_ == EngineMode::all_pairs) return;
  for (std::uint32_t i = 0; i < d.size(); ++i) keep_level(d, i);
}

void NeighbourLists::keep_level(const Disks& d, std::uint32_t i) {
  if (!(growth_ > 0.0) || d.radius.empty()) return;
  kept_level_.resize(std::max<std::size_t>(kept_level_.size(), i + 1));
  kept_level_[i] = static_cast<std::uint8_t>(level_of_radius(d.radius[i] + growth_));
}

// Moves the disk to the cell of this position. Returns false, without a change, if its old cell is outside the region.
bool NeighbourLists::move_to_cell_of(const Disks& d, std::uint32_t i, FixedPointPosition position,
                                     const ListRegion& region) {
  const std::size_t level = level_of(d, i);
  const std::uint32_t old_key = cell_in(level, rows_.listed_at(i));
  const std::uint32_t new_key = cell_in(level, position);
  if (old_key < region.first_key || old_key >= region.last_key) return false;
  slots_.remove(old_key, i);
  const float radius = d.radius.empty() ? 0.0F : radius_in_units(d.radius[i]);
  slots_.insert(new_key, i, slot_position(position), radius);
  return true;
}

}  // namespace carom
