#include "parallel/exact/neighbour_lists.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/physics/boundary.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "parallel/cells/crowding.hpp"
#include "parallel/exact/most_listed.hpp"

namespace carom {

namespace {

// Without tiles: the number of disks whose long lists share a vector; enough that there are few vectors, and few enough
// that blocks can be distributed among threads. The number of a block has 16 bits.
constexpr std::size_t disks_per_block = 4096;
constexpr std::size_t most_blocks = 65536;
// With this factor a slightly larger disk that comes to a part does not require new lists, and a giant elsewhere does
// not make searches longer.
constexpr double hardly_larger = 1.1;

}  // namespace

void FoundNeighbours::grow(std::size_t disks) {
  buffer.resize(2 * (disks + list_kernel_padding));
}

void NeighbourLists::build(Disks& d, const Domain& box, const ListLayout& layout, const Executor& executor,
                           const Sorted& sorted) {
  check_listed(d.size());
  mode_ = layout.mode;
  box_ = box;
  listed_box_ = ListedBox(box);
  layers_along_x_ = box.width >= box.height;
  images_alone_ = box.periodic_x() && box.periodic_y() && !flow_.acts && box.obstacles == nullptr;
  const std::size_t n = d.size();
  const bool gives_back = std::max(n, layout.disks_of_box) > disks_of_much_memory;
  largest_radius_ = largest_radius(d);
  if (layout.largest_of_box < hardly_larger * largest_radius_) {
    largest_radius_ = std::max(largest_radius_, layout.largest_of_box);
  }
  growth_ = layout.growth;
  grid_.tiles = grid_.tiles_a_layer = 1;
  grid_.tile_keys = 0;
  near_border_ = elsewhere_ = {};
  if (mode_ != EngineMode::all_pairs) {
    const double crowded = mode_ == EngineMode::regions ? 1.0 : crowding(d, box, layout.disks_of_box);
    choose_skin(d, layout, crowded);
    // The memory of the rows is freed first, since sorting needs some.
    if (gives_back) rows_.release();
    if (growth_ > 0.0) {
      sort_grown(d, layout, crowded, executor);
    } else {
      sort(d, layout, crowded, executor);
    }
    choose_slot_units();
    prepare_query(d);
    if (sorted) sorted(cells_.order, cells_.column);
    if (gives_back) release_sort_scratch(cells_);
  }
  find_tiles(n);
  find_inner_part();
  list_all(d, executor);
  if (gives_back) std::vector<std::uint32_t>().swap(cells_.start);
}

void NeighbourLists::set_listed_positions(const Disks& d, const Executor& executor) {
  executor.for_ranges(d.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 at = flow_.acts ? into_flow(d.x[i], d.y[i], 0.0) : Vec2{d.x[i], d.y[i]};
      rows_.set_listed_at(static_cast<std::uint32_t>(i), listed_box_.fixed_point(at.x, at.y));
    }
  });
}

void NeighbourLists::list_all(const Disks& d, const Executor& executor) {
  if (mode_ != EngineMode::all_pairs) {
    slots_.begin(grid_.keys, grid_.tile_keys == 0 ? grid_.keys : grid_.tile_keys, !d.radius.empty());
    list_levels();
  }
  keep_levels(d);
  if (mode_ == EngineMode::regions) {
    rows_.begin(d.size(), grid_.tiles);
    set_listed_positions(d, executor);
    executor.run(grid_.tiles, [&](std::size_t t) {
      const auto tile = static_cast<std::uint32_t>(t);
      fill_slots(d, tile * grid_.tile_keys, (tile + 1) * grid_.tile_keys);
    });
    executor.run(grid_.tiles, [&](std::size_t t) {
      const auto tile = static_cast<std::uint32_t>(t);
      list_block(d, t, first_disk_of(tile), first_disk_of(tile + 1));
    });
  } else {
    const std::size_t per_block = std::max(disks_per_block, d.size() / most_blocks + 1);
    rows_.begin(d.size(), executor.blocks(d.size(), per_block));
    set_listed_positions(d, executor);
    if (is_sorted_by_place()) {
      for (std::uint32_t i = 0; i < d.size(); ++i) fill_slot(d, i);
    } else if (mode_ == EngineMode::single_queue) {
      fill_slots(d, 0, grid_.keys);
    }
    executor.for_ranges(d.size(), per_block,
                        [&](std::size_t b, std::size_t begin, std::size_t end) { list_block(d, b, begin, end); });
  }
}

void NeighbourLists::list_block(const Disks& d, std::size_t block, std::size_t begin, std::size_t end) {
  thread_local FoundNeighbours found;
  rows_.clear_block(block);
  const ListRegion everything;
  for (std::size_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    rows_.enter(i, block, find_sides(d, i));
    if (mode_ == EngineMode::all_pairs) {
      find_all_others(i, found);
    } else {
      find_neighbours(d, i, rows_.listed_at(i), everything, found);
    }
    rows_.set(i, found.disks());
  }
}

void NeighbourLists::visit_lists(const Executor& executor,
                                 const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const {
  executor.for_ranges(rows_.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> near;
    for (std::size_t i = begin; i < end; ++i) {
      near.clear();
      for_each_neighbour(static_cast<std::uint32_t>(i), [&](std::uint32_t j) { near.push_back(j); });
      visit(i, near);
    }
  });
}

void NeighbourLists::find_all_others(std::uint32_t i, FoundNeighbours& found) const {
  found.buffer.resize(rows_.size());
  std::iota(found.buffer.begin(), found.buffer.end(), 0U);
  found.buffer.erase(found.buffer.begin() + i);
  found.count = found.buffer.size();
}

// Can the disk touch an obstacle while it stays within the skin of its listed position, and until the end of the window
// if obstacles move? Precondition: there are obstacles.
bool NeighbourLists::may_touch_obstacle(Vec2 listed, double radius) const {
  if (mode_ == EngineMode::all_pairs) return true;
  const double reach = (radius + skin_) * (1.0 + 1e-6) + std::max(listed_box_.unit.x, listed_box_.unit.y);
  if (box_.obstacles->clearance(listed) >= reach) return false;
  if (box_.obstacles->move()) return true;
  bool may = false;
  for_each_obstacle_touched(box_, listed.x, listed.y, reach, [&](std::uint32_t, const ObstacleGap&) { may = true; });
  return may;
}

void NeighbourLists::see_where_walls_move(const Disks& d, const Executor& executor) {
  executor.for_ranges(rows_.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      const bool near = may_touch_obstacle(listed_position(i), d.radius_of(i));
      rows_.set_sides(i, (rows_.row(i).sides & ~ListRow::obstacle_near) | (near ? ListRow::obstacle_near : 0U));
    }
  });
}

unsigned NeighbourLists::find_other_sides(const Disks& d, std::uint32_t i) const {
  const Vec2 position = listed_position(i);
  unsigned sides = 0;
  if (flow_.acts && !is_inside_in_height(position)) sides |= ListRow::images_move;
  if (box_.obstacles != nullptr && may_touch_obstacle(position, d.radius_of(i))) sides |= ListRow::obstacle_near;
  for (const Side side : all_sides) {
    if (box_.side(side) == SideKind::periodic) continue;
    // A side that moves may come this far into the box.
    const double furthest = box_.motions[static_cast<std::size_t>(side)].furthest;
    const double gap = -reach_beyond(side, position.x, position.y, d.radius_of(i), box_) - furthest;
    if (mode_ == EngineMode::all_pairs || gap <= skin_) sides |= 1U << static_cast<unsigned>(side);
  }
  return sides;
}

bool NeighbourLists::take_list(std::uint32_t i, const Disks& d, const ListRegion& region,
                               const FoundNeighbours& found) {
  const bool all_pairs = mode_ == EngineMode::all_pairs;
  if (!all_pairs && !move_to_cell_of(d, i, found.at, region)) return false;
  rows_.set_listed_at(i, found.at);
  if (all_pairs) return true;
  rows_.set_sides(i, find_sides(d, i));
  rows_.replace(i, found.disks(), region);
  return true;
}

}  // namespace carom
