#include "parallel/cells/tiled_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace carom {

namespace {

// The number of cells of a tile is a power of two, so the real value is within a factor of 1.4 of this. A cell has
// eight slots (CellSlots).
constexpr double disks_per_cell = 5.0;
// Nearly the largest value possible with that rounding, so that there are few cells (even_tile).
constexpr double disks_per_even_cell = 1.3 * disks_per_cell;
// The number of a tile must fit in 16 bits; rounding of the sides may double the number of tiles.
constexpr double most_tiles = 30000.0;
// Enough for regions to get nearly the same number of disks if these are unevenly spread.
constexpr std::uint32_t most_layers_a_region = 8;
// In thinner layers most searches would extend over two.
constexpr double least_cells_a_layer = 8.0;

// So many groups must be left out that a disk outside the tiles that are kept is nearer to one end of them than to the
// other.
constexpr std::int64_t least_groups_left_out = 2;

// log2 of the number of parts of about this size in the whole.
unsigned shift_for(double whole, double part) {
  return static_cast<unsigned>(std::clamp(std::lround(std::log2(std::max(1.0, whole / part))), 0L, 20L));
}

std::uint32_t parts_of(double whole, double part) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(whole / part)));
}

// The number of layers along a side of the box. cell: of the most frequent class; part: thickness wanted; lengths.
std::uint32_t layers_for(double side, double cell, double part, std::size_t regions) {
  const auto most = static_cast<std::uint32_t>(std::clamp(side / (least_cells_a_layer * cell), 1.0, most_tiles));
  const auto shares = static_cast<std::uint32_t>(regions);
  const std::uint32_t few = most < shares ? most : shares * std::min(most / shares, most_layers_a_region);
  return std::max(few, shares * (parts_of(side, part) / shares));
}

}  // namespace

void make_tiled_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                     std::size_t disks_per_tile, std::size_t regions, CellGrid& grid) {
  const double n = static_cast<double>(std::accumulate(count.begin(), count.end(), std::size_t{0}));
  const double area = box.width * box.height;
  const auto cell_of = [&](double disks) { return std::sqrt(area / (disks / disks_per_cell + 1.0)); };
  const double most = static_cast<double>(*std::max_element(count.begin(), count.end()));
  const double tile_area = std::max(static_cast<double>(disks_per_tile), n / most_tiles) * area / n;
  const double longer = std::max(box.width, box.height);
  const double shorter = std::min(box.width, box.height);
  // In a box narrower than a square tile, a tile extends from side to side and is longer.
  const double thickness = std::max(std::sqrt(tile_area), tile_area / shorter);
  const std::uint32_t layers = layers_for(longer, cell_of(most), thickness, regions);
  const std::uint32_t tiles_a_layer = parts_of(shorter, tile_area / (longer / layers));
  const bool wide = box.width >= box.height;
  const std::uint32_t bands = wide ? layers : tiles_a_layer;
  const std::uint32_t groups = wide ? tiles_a_layer : layers;
  const double width = box.width / bands;
  const double height = box.height / groups;
  grid.levels.clear();
  grid.tile_keys = 0;
  double radius = largest_radius;
  for (std::size_t k = 0; k < count.size(); ++k, radius /= class_ratio) {
    GridLevel level;
    level.largest_radius = radius;
    const double cell = cell_of(static_cast<double>(count[k]));
    // The number of a tile's cells is rounded first: if both sides were rounded separately, cells could have half or
    // twice as many disks.
    const unsigned shift = shift_for(width * height, cell * cell);
    const double band_shift = 0.5 * (shift + std::log2(width / height));
    level.band_shift = static_cast<unsigned>(std::lround(std::clamp<double>(band_shift, 0.0, shift)));
    level.group_shift = shift - level.band_shift;
    level.columns = bands << level.band_shift;
    level.rows = groups << level.group_shift;
    level.kept_rows = level.rows;
    level.cell_width = box.width / level.columns;
    level.cell_height = box.height / level.rows;
    level.columns_per_length = level.columns / box.width;
    level.rows_per_length = level.rows / box.height;
    level.stride = 1U << level.band_shift;
    level.first_key = grid.tile_keys;
    grid.tile_keys += level.stride << level.group_shift;
    grid.levels.push_back(level);
  }
  for (GridLevel& level : grid.levels) {
    level.group_keys = wide ? grid.tile_keys : bands * grid.tile_keys;
    level.band_keys = wide ? groups * grid.tile_keys : grid.tile_keys;
  }
  grid.tiles = bands * groups;
  grid.tiles_a_layer = tiles_a_layer;
  grid.keys = grid.tiles * grid.tile_keys;
}

std::size_t even_tile(std::size_t wanted, std::size_t disks_of_box) {
  const auto cells_of = [](double disks) { return std::log2(std::max(1.0, disks / disks_per_even_cell)); };
  const double least = std::ceil(cells_of(static_cast<double>(disks_of_box) / most_tiles));
  const double most = std::floor(cells_of(static_cast<double>(wanted)));
  return static_cast<std::size_t>(disks_per_even_cell * std::exp2(std::max(least, most)));
}

void keep_tiles_between(const Domain& box, double low, double high, CellGrid& grid) {
  const std::uint32_t groups = grid.levels[0].rows >> grid.levels[0].group_shift;
  const auto group_at = [&](double y) { return static_cast<std::int64_t>(std::floor(y / box.height * groups)); };
  std::int64_t first = group_at(low);
  std::int64_t last = group_at(high);
  if (!box.periodic_y()) {
    first = std::clamp<std::int64_t>(first, 0, groups - 1);
    last = std::clamp<std::int64_t>(last, 0, groups - 1);
  }
  if (last - first + 1 + least_groups_left_out > groups) return;
  const auto kept = static_cast<std::uint32_t>(last - first + 1);
  const auto skipped = static_cast<std::uint32_t>((first % groups + groups) % groups);
  const bool wide = box.width >= box.height;
  for (GridLevel& level : grid.levels) {
    level.stored_rows = {skipped << level.group_shift, kept << level.group_shift};
    if (wide) level.band_keys = kept * grid.tile_keys;
  }
  grid.tiles = grid.tiles / groups * kept;
  if (wide) grid.tiles_a_layer = kept;
  grid.keys = grid.tiles * grid.tile_keys;
}

}  // namespace carom
