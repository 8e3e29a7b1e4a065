// The layout of the neighbour lists: the skin, the cells into which disks are sorted, their tiles and regions, and the
// inner part of the box, whose disks have no neighbours across a border.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "parallel/cells/tiled_grid.hpp"
#include "parallel/exact/neighbour_lists.hpp"

namespace carom {

namespace {

// Twice the skin and a diameter make this many mean spacings: about eleven neighbours. Longer lists take longer to
// visit; shorter ones have to be renewed more often, the sooner the less dense the system is. With one queue the fewest
// instructions a collision are at 2.05 to 2.2, 1.8 to 1.9 and 1.72 spacings at packing fractions 0.2, 0.5 and 0.7 (10^4
// disks), and at 1.8 to 2.1 from 0.1 down to 0.005 (2000 disks), where disks fly further than the width of a list.
constexpr double region_cutoff = 1.85;

double cutoff_in_spacings(double packing_fraction) {
  return std::min(2.35 - 0.9 * packing_fraction, 1.95 + 1.1 * packing_fraction);
}

// If disks crowd, most cells are empty: with many disks, the number of cells grows by at most this factor.
constexpr double most_crowding_of_many = 8.0;
// In very dense systems the skin is at least this share of a mean diameter.
constexpr double least_skin = 0.08;
// The least skin in units of listed positions, so that their rounding does not matter.
constexpr double least_units = 1024.0;
// Disks of different sizes are sorted by cells of about half this number of disks.
constexpr std::size_t disks_of_a_place = 4;
// The largest share of the skin that is kept for the growth of radii.
constexpr double most_growth = 0.6;

double crowding_of_cells(double crowded, std::size_t disks) {
  return disks > disks_of_much_memory ? std::min(crowded, most_crowding_of_many) : crowded;
}

}  // namespace

// crowded: the density around the disks over the mean density (crowding.hpp).
void NeighbourLists::choose_skin(const Disks& d, const ListLayout& layout, double crowded) {
  // A part of the box may have no disks yet.
  const double n = std::max<double>(1.0, static_cast<double>(d.size()));
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
  // The share of the box that belongs to these disks, the other disks having theirs.
  const double share = layout.disks_of_box > 0 ? n / static_cast<double>(layout.disks_of_box) : 1.0;
  const double space = share * box_.width * box_.height;
  const double packing_fraction = std::min(crowded * area / space, 1.0);
  const double cutoff = mode_ == EngineMode::regions ? region_cutoff : cutoff_in_spacings(packing_fraction);
  skin_ = std::max({0.5 * (cutoff * std::sqrt(space / (crowded * n)) - 2.0 * radius), least_skin * 2.0 * radius,
                    least_units * std::max(listed_box_.unit.x, listed_box_.unit.y)});
  skin_ = std::min(skin_, largest_skin(box_));
  growth_ = layout.growth <= most_growth * skin_ ? layout.growth : 0.0;
  near_border_ = relist_distance_of(layout.relist_share * (skin_ - growth_));
  elsewhere_ = relist_distance_of(skin_ - growth_);
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
    if (layout.disks_of_box > 0) keep_tiles_between(box_, layout.low.y, layout.high.y, grid_);
  } else {
    // A cell has on average half of this number of disks, and room for eight: lists extend over several cells, and each
    // costs as much to visit, empty or not. There are fewer a cell in a dilute gas, whose disks lie less evenly, so
    // that more cells overflow, and more if there are many disks, to save memory.
    const std::size_t disks = std::max(d.size(), layout.disks_of_box);
    const bool are_many = disks > disks_of_much_memory;
    const bool is_dilute = skin_ > 4.0 * largest;
    const std::size_t twice_a_cell = (is_dilute ? 6U : 8U) + (are_many ? 2U : 0U);
    for (std::size_t& c : count) c = c / twice_a_cell + 1;
    make_grid(box_, largest, count, grid_, grid_margin, crowding_of_cells(crowded, disks));
    store_cells_between(box_, layout.low, layout.high, grid_);
  }
  if (is_sorted_by_place()) {
    sort_by_place(d, layout, crowded, executor);
  } else {
    sort_into_cells(d, grid_, executor, cells_);
  }
}

// Used if radii are so different that cells have several levels: disks that are neighbours are stored near each other,
// whatever their sizes, so that offsets to them are small.
void NeighbourLists::sort_by_place(Disks& d, const ListLayout& layout, double crowded, const Executor& executor) {
  const std::size_t disks = std::max(layout.disks_of_box, d.size());
  CellGrid places;
  make_grid(box_, smallest_radius(d), {disks / disks_of_a_place + 1}, places, grid_margin,
            crowding_of_cells(crowded, disks));
  store_cells_between(box_, layout.low, layout.high, places);
  sort_into_cells(d, places, executor, cells_);
}

// Sorts the disks by the radii to which they may grow. So disks that have the same radius in the end are seldom in two
// size classes, apart in memory.
void NeighbourLists::sort_grown(Disks& d, const ListLayout& layout, double crowded, const Executor& executor) {
  largest_radius_ += growth_;
  const std::vector<double> radius = d.radius;
  for (double& r : d.radius) r += growth_;
  sort(d, layout, crowded, executor);
  for (std::size_t i = 0; i < radius.size(); ++i) d.radius[i] = radius[cells_.order[i]];
}

void NeighbourLists::find_tiles(std::size_t disks) {
  first_of_tile_.assign(std::size_t{grid_.tiles} + 1, static_cast<std::uint32_t>(disks));
  first_of_tile_[0] = 0;
  for (std::uint32_t tile = 1; tile < grid_.tiles; ++tile) {
    first_of_tile_[tile] = cells_.start[std::size_t{tile} * grid_.tile_keys];
  }
}

// The depth of the core within the region follows from this: a disk is relisted within the relist distance of its
// listed position, at a place that is ahead of it by less than that, and its new list has the usual reach from there.
ListRegion NeighbourLists::region_of_tiles(std::uint32_t first, std::uint32_t last) const {
  ListRegion region{first * grid_.tile_keys, last * grid_.tile_keys, first_disk_of(first), first_disk_of(last)};
  const double side = layers_along_x_ ? box_.width : box_.height;
  const double unit = layers_along_x_ ? listed_box_.unit.x : listed_box_.unit.y;
  const double tiles_to_length = side / static_cast<double>(grid_.tiles);
  const double depth = 2.0 * largest_radius_ + 3.0 * skin_ + search_margin_ + most_lead * near_border_.length;
  const double from = first * tiles_to_length + depth;
  const double size = last * tiles_to_length - depth - from;
  region.core_is_of_x = layers_along_x_;
  region.core = region.core_size = 0;
  if (!(size > 0.0)) return region;
  // Both are less than the side, so they fit in 32 bits.
  region.core = static_cast<std::uint32_t>(from / unit);
  region.core_size = static_cast<std::uint32_t>(size / unit);
  return region;
}

void NeighbourLists::set_core_between(double low, double high, ListRegion& region) const {
  constexpr double most = 0xfffffffeU;
  region.core_is_of_x = false;
  region.core = static_cast<std::uint32_t>(std::clamp(low / listed_box_.unit.y, 0.0, most));
  region.core_size = static_cast<std::uint32_t>(std::clamp((high - low) / listed_box_.unit.y, 0.0, most));
}

// While disks that list each other stay listed, they are within their contact distance and 4 skins of each other, and
// each is within the skin of its listed position.
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

}  // namespace carom
