// Changes of neighbour lists between windows, when a program or a source adds disks, or a program removes some.
#include <vector>

#include "parallel/exact/most_listed.hpp"
#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

void NeighbourLists::append(const Disks& d, std::uint32_t i, Vec2 at) {
  check_listed(std::size_t{i} + 1);
  const FixedPointPosition position = listed_box_.fixed_point(at.x, at.y);
  const ListRegion everything;
  ++first_of_tile_.back();
  keep_level(d, i);
  rows_.append(position);
  rows_.set_sides(i, find_sides(d, i));
  FoundNeighbours found;
  find_neighbours(d, i, position, everything, found);
  slots_.insert(cell_in(level_of(d, i), position), i, slot_position(position), radius_in_units(d.radius_of(i)));
  rows_.replace(i, found.disks(), everything);
}

void NeighbourLists::remove(std::uint32_t i, const Disks& d) {
  const auto last = static_cast<std::uint32_t>(d.size() - 1);
  const ListRegion everything;
  const auto take_out = [&](std::uint32_t disk) {
    rows_.replace(disk, {}, everything);
    slots_.remove(cell_in(level_of(d, disk), rows_.listed_at(disk)), disk);
  };
  take_out(i);
  if (i != last) {
    std::vector<std::uint32_t> near;
    for_each_neighbour(last, [&](std::uint32_t j) { near.push_back(j); });
    const std::uint32_t cell = cell_in(level_of(d, last), rows_.listed_at(last));
    take_out(last);
    const FixedPointPosition at = rows_.listed_at(last);
    rows_.set_listed_at(i, at);
    slots_.insert(cell, i, slot_position(at), radius_in_units(d.radius_of(last)));
    rows_.set_sides(i, rows_.row(last).sides & ~ListRow::has_more);
    rows_.replace(i, near, everything);
  }
  if (!kept_level_.empty()) {
    kept_level_[i] = kept_level_.back();
    kept_level_.pop_back();
  }
  rows_.drop_last();
  --first_of_tile_.back();
}

}  // namespace carom
