#include "parallel/exact/neighbour_lists.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/physics/boundary.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "parallel/cells/crowding.hpp"
#include "parallel/cells/tiled_grid.hpp"

namespace carom {

namespace {

// Without tiles: disks whose long lists share a vector. Enough that there are few vectors, and few enough to share them
// out among threads. The number of a block has 16 bits.
constexpr std::size_t disks_per_block = 4096;
constexpr std::size_t most_blocks = 65536;
// Twice the skin and a diameter make this many mean spacings: about eleven neighbours. Longer lists take longer to go
// through, shorter ones have to be renewed more often, the sooner the less dense the system is: with one queue the
// fewest instructions a collision are at 2.05 to 2.2, 1.8 to 1.9 and 1.72 spacings at packing fractions 0.2, 0.5 and
// 0.7 (10^4 disks), at 1.8 to 2.1 from 0.1 down to 0.005 (2000 disks), where disks fly further than across a list.
constexpr double region_cutoff = 1.85;

double cutoff_in_spacings(double packing_fraction) {
  return std::min(2.35 - 0.9 * packing_fraction, 1.95 + 1.1 * packing_fraction);
}

// Where disks crowd most cells are empty: with many disks, at most so many times as many cells are made.
constexpr double most_crowding_of_many = 8.0;
// A disk is listed ahead of where it is by at most this share of the relist distance, since it has to be within that
// distance, less what gravity may bend its path by (bend_share): where it is not, it is due at once, for ever.
constexpr double most_lead = 0.8;
// In very dense systems the skin is at least this share of a mean diameter.
constexpr double least_skin = 0.08;
// The most, of a period. A path that ends within the skin of its listed position is taken to have stayed there
// (stays_listed), so it must not come to an image of that place from the one before: a path covers a quarter of a
// period at most (longest_flight), in the frame of a flow less than 0.7.
constexpr double most_skin = 0.37;
constexpr double most_skin_in_flow = 0.15;
// The least skin in units of listed positions, so that their rounding does not matter.
constexpr double least_units = 1024.0;
constexpr double two_to_31 = 2147483648.0;

RelistDistance relist_distance_of(double length) {
  return {length, length * length * (1.0 - 2e-9), most_lead * most_lead * length * length};
}

}  // namespace

void FoundNeighbours::grow(std::size_t disks) {
  buffer.resize(2 * (disks + list_kernel_padding));
}

// crowded: how much denser than in the mean it is around the disks (crowding.hpp).
void NeighbourLists::choose_skin(const Disks& d, const ListLayout& layout, double crowded) {
  const double n = static_cast<double>(d.size());
  double radius = 0.0;
  double area = 0.0;
  for (const double r : d.radius) {
    radius += r / n;
    area += std::numbers::pi * r * r;
  }
  if (d.radius.empty()) {
    radius = d.common_radius;
    area = n * std::numbers::pi * radius * radius;
  }
  // The share of the box that these disks have, if the others have theirs.
  const double share = layout.disks_of_box > 0 ? n / static_cast<double>(layout.disks_of_box) : 1.0;
  const double space = share * box_.width * box_.height;
  const double packing_fraction = std::min(crowded * area / space, 1.0);
  const double cutoff = mode_ == EngineMode::regions ? region_cutoff : cutoff_in_spacings(packing_fraction);
  skin_ = std::max({0.5 * (cutoff * std::sqrt(space / (crowded * n)) - 2.0 * radius), least_skin * 2.0 * radius,
                    least_units * std::max(unit_x_, unit_y_)});
  const double most = flow_.acts ? most_skin_in_flow : most_skin;
  if (box_.periodic_x()) skin_ = std::min(skin_, most * box_.width);
  if (box_.periodic_y()) skin_ = std::min(skin_, most * box_.height);
  near_border_ = relist_distance_of(layout.relist_share * skin_);
  elsewhere_ = relist_distance_of(skin_);
  elsewhere_.lead2 = near_border_.lead2;
}

void NeighbourLists::sort(Disks& d, const ListLayout& layout, double crowded, const Executor& executor) {
  const double largest = largest_radius_;
  std::vector<std::size_t> count = count_classes(d, largest);
  if (layout.disks_of_box > 0) {
    // Cells are those of the whole box.
    const double others =
        static_cast<double>(layout.disks_of_box) / std::max<double>(1.0, static_cast<double>(d.size()));
    for (std::size_t& c : count) c = static_cast<std::size_t>(others * static_cast<double>(c));
  }
  if (layout.disks_per_tile > 0) {
    make_tiled_grid(box_, largest, count, layout.disks_per_tile, layout.regions, grid_);
    if (layout.disks_of_box > 0) keep_tiles_between(box_, layout.low, layout.high, grid_);
  } else {
    // Half of this many disks a cell, which has room for eight: lists extend over several cells, and each costs as much
    // to visit, empty or not. A few less in a dilute gas, whose disks lie less evenly, so that more cells overflow; a
    // few more where they are many, for memory's sake.
    const bool are_many = std::max(d.size(), layout.disks_of_box) > disks_of_much_memory;
    const bool is_dilute = skin_ > 4.0 * largest;
    const std::size_t twice_a_cell = (is_dilute ? 6U : 8U) + (are_many ? 2U : 0U);
    for (std::size_t& c : count) c = c / twice_a_cell + 1;
    make_grid(box_, largest, count, grid_, grid_margin, are_many ? std::min(crowded, most_crowding_of_many) : crowded);
    if (layout.low < layout.high) store_rows_between(box_, layout.low, layout.high, grid_);
  }
  sort_into_cells(d, grid_, executor, cells_);
}

void NeighbourLists::build(Disks& d, const Domain& box, const ListLayout& layout, const Executor& executor,
                           const Sorted& sorted) {
  mode_ = layout.mode;
  box_ = box;
  unit_x_ = box.width / (box.periodic_x() ? 2.0 * two_to_31 : two_to_31);
  unit_y_ = box.height / (box.periodic_y() ? 2.0 * two_to_31 : two_to_31);
  units_per_x_ = 1.0 / unit_x_;
  units_per_y_ = 1.0 / unit_y_;
  layers_along_x_ = box.width >= box.height;
  images_alone_ = box.periodic_x() && box.periodic_y() && !flow_.acts && box.obstacles == nullptr;
  period_x_ = box.periodic_x() ? box.width : 0.0;
  period_y_ = box.periodic_y() ? box.height : 0.0;
  periods_per_x_ = box.periodic_x() ? 1.0 / box.width : 0.0;
  periods_per_y_ = box.periodic_y() ? 1.0 / box.height : 0.0;
  const std::size_t n = d.size();
  const bool gives_back = std::max(n, layout.disks_of_box) > disks_of_much_memory;
  largest_radius_ = largest_radius(d);
  grid_.tiles = grid_.tiles_a_layer = 1;
  grid_.tile_keys = 0;
  near_border_ = elsewhere_ = {};
  if (mode_ != EngineMode::all_pairs) {
    const double crowded = mode_ == EngineMode::regions ? 1.0 : crowding(d, box, layout.disks_of_box);
    choose_skin(d, layout, crowded);
    // The memory of the rows is given back, as sorting needs some.
    if (gives_back) rows_.release();
    sort(d, layout, crowded, executor);
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

// How deep the core lies within the region: a disk is relisted within the relist distance of its listed position, at a
// place that is ahead of it by less than that, and its new list reaches no further than lists do from there.
ListRegion NeighbourLists::region_of_tiles(std::uint32_t first, std::uint32_t last) const {
  ListRegion region{first * grid_.tile_keys, last * grid_.tile_keys, first_disk_of(first), first_disk_of(last)};
  const double side = layers_along_x_ ? box_.width : box_.height;
  const double unit = layers_along_x_ ? unit_x_ : unit_y_;
  const double tiles_to_length = side / static_cast<double>(grid_.tiles);
  const double depth = 2.0 * largest_radius_ + 3.0 * skin_ + search_margin_ + most_lead * near_border_.length;
  const double from = first * tiles_to_length + depth;
  const double size = last * tiles_to_length - depth - from;
  region.core_is_of_x = layers_along_x_;
  region.core = region.core_size = 0;
  if (!(size > 0.0)) return region;
  // Both are less than the side, so that they fit.
  region.core = static_cast<std::uint32_t>(from / unit);
  region.core_size = static_cast<std::uint32_t>(size / unit);
  return region;
}

void NeighbourLists::set_core_between(double low, double high, ListRegion& region) const {
  constexpr double most = 0xfffffffeU;
  region.core_is_of_x = false;
  region.core = static_cast<std::uint32_t>(std::clamp(low / unit_y_, 0.0, most));
  region.core_size = static_cast<std::uint32_t>(std::clamp((high - low) / unit_y_, 0.0, most));
}

void NeighbourLists::set_listed_positions(const Disks& d, const Executor& executor) {
  executor.for_ranges(d.size(), disks_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 at = flow_.acts ? into_flow(d.x[i], d.y[i], 0.0) : Vec2{d.x[i], d.y[i]};
      rows_.set_listed_at(static_cast<std::uint32_t>(i), fixed_point(at.x, at.y));
    }
  });
}

void NeighbourLists::list_all(const Disks& d, const Executor& executor) {
  if (mode_ != EngineMode::all_pairs) {
    slots_.begin(grid_.keys, grid_.tile_keys == 0 ? grid_.keys : grid_.tile_keys, !d.radius.empty());
    list_levels();
  }
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
    if (mode_ == EngineMode::single_queue) fill_slots(d, 0, grid_.keys);
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

// Along a period the whole number wraps by itself; between walls a rounding error may lead outside.
FixedPointPosition NeighbourLists::fixed_point(double x, double y) const {
  const auto units = [](double c, double unit, bool periodic) {
    const auto whole = static_cast<std::int64_t>(c / unit);
    return static_cast<std::uint32_t>(periodic ? whole : std::clamp(whole, std::int64_t{0}, std::int64_t{1} << 31));
  };
  return {units(x, unit_x_, box_.periodic_x()), units(y, unit_y_, box_.periodic_y())};
}

void NeighbourLists::find_all_others(std::uint32_t i, FoundNeighbours& found) const {
  found.buffer.resize(rows_.size());
  std::iota(found.buffer.begin(), found.buffer.end(), 0U);
  found.buffer.erase(found.buffer.begin() + i);
  found.count = found.buffer.size();
}

// Disks that list each other are within their contact distance and 4 skins of each other while they stay listed, and
// each is within the skin of where it is listed.
void NeighbourLists::find_inner_part() {
  const double reach = (2.0 * flow_.stretch * largest_radius_ + 4.0 * skin_ + search_margin_) * (1.0 + 1e-6);
  const double depth = mode_ == EngineMode::all_pairs ? never : reach;
  const auto part = [](double side, bool periodic, double away, double& low, double& high) {
    low = periodic ? away : -never;
    high = periodic ? side - away : never;
  };
  part(box_.width, box_.periodic_x(), flow_.acts ? never : depth, inner_low_.x, inner_high_.x);
  part(box_.height, box_.periodic_y(), depth, inner_low_.y, inner_high_.y);
}

// While it stays within the skin of its listed position. An obstacle that moves may come anywhere. Precondition: there
// are obstacles.
bool NeighbourLists::may_touch_obstacle(Vec2 listed, double radius) const {
  if (mode_ == EngineMode::all_pairs || box_.inner_walls_move) return true;
  const double reach = (radius + skin_) * (1.0 + 1e-6) + std::max(unit_x_, unit_y_);
  if (box_.obstacles->clearance(listed) >= reach) return false;
  bool may = false;
  for_each_obstacle_touched(box_, listed.x, listed.y, reach, [&](std::uint32_t, const ObstacleGap&) { may = true; });
  return may;
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

double NeighbourLists::earliest_relist_time(std::uint32_t i, const PathSegment& path, double from, double until,
                                            const Gravity& gravity, const RelistDistance& relist) const {
  static_assert(most_lead < 1.0 - bend_share);
  if (mode_ == EngineMode::all_pairs) return never;
  if (flow_.acts) return earliest_relist_in_flow(i, path, from, until);
  const PathSegment p = carried_to(path, from, gravity);
  const double g = gravity.size;
  const Vec2 position = listed_position(i);
  const auto [dx, dy] = nearest_image_at_rest({p.x - position.x, p.y - position.y}, box_);
  double room = relist.length * (1.0 - 1e-9);
  double ahead = never;
  if (g > 0.0) {
    // The straight path, less what gravity can bend it by in that time.
    ahead = std::max(std::sqrt(2.0 * bend_share * relist.length / g), until - from);
    room -= 0.5 * g * ahead * ahead;
    if (!(room > 0.0)) return from;
  }
  return from + std::min(time_within(room * room, {dx, dy}, {p.vx, p.vy}), ahead);
}

// A straight path whose ends are in a circle is in it; gravity bends it by g t^2 / 8 at most, so that it has to begin
// and end further inside.
bool NeighbourLists::stays_listed_falling(std::uint32_t i, const PathSegment& path, double from, double until,
                                          const Gravity& g, const RelistDistance& relist) const {
  if (mode_ == EngineMode::all_pairs) return true;
  const double room = relist.length * (1.0 - 1e-9) - 0.125 * g.size * (until - from) * (until - from);
  const auto inside = [&](double t) {
    const double s = t - path.start;
    return is_within(i, path.x + (path.vx - 0.5 * g.left * s) * s, path.y + (path.vy - 0.5 * g.down * s) * s,
                     room * room);
  };
  return room > 0.0 && inside(until) && inside(from);
}

// Listed disks are within their contact distance and 4 skins of each other, carried back to the window's start by two
// flights more; where that is less than half a period, the nearest image is the right one.
double NeighbourLists::safe_speed2(double length, double g) const {
  double period = HUGE_VAL;
  if (box_.periodic_x()) period = std::min(period, box_.width);
  if (box_.periodic_y()) period = std::min(period, box_.height);
  if (period == HUGE_VAL) return HUGE_VAL;
  if (mode_ == EngineMode::all_pairs) return -1.0;
  const double listed = flow_.stretch * (2.0 * flow_.stretch * largest_radius_ + 4.0 * skin_ + search_margin_);
  const double flight = 0.5 * (0.49 * period - listed) - g * length * length;
  return flight > 0.0 ? (flight / length) * (flight / length) : -1.0;
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
