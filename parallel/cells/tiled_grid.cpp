#include "parallel/cells/tiled_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace carom {

namespace {

constexpr double disks_per_cell = 2.0;
// The number of a tile has to fit in 16 bits; sides that are rounded make up to twice as many.
constexpr double most_tiles = 30000.0;

// log2 of the number of parts of about this size in the whole.
unsigned shift_for(double whole, double part) {
  return static_cast<unsigned>(std::clamp(std::lround(std::log2(std::max(1.0, whole / part))), 0L, 20L));
}

std::uint32_t tiles_along(double length, double side) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(length / side)));
}

}  // namespace

void make_tiled_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                     std::size_t disks_per_tile, CellGrid& grid) {
  const double n = static_cast<double>(std::accumulate(count.begin(), count.end(), std::size_t{0}));
  const double area = box.width * box.height;
  const auto cell_of = [&](double disks) { return std::sqrt(area / (disks / disks_per_cell + 1.0)); };
  const double most = static_cast<double>(*std::max_element(count.begin(), count.end()));
  // A tile's sides are whole numbers of cells of the most frequent class, powers of two; it is square or twice as high.
  const double wanted = std::max(static_cast<double>(disks_per_tile), n / most_tiles) * most / n;
  const unsigned shift = shift_for(wanted, disks_per_cell);
  const double side = cell_of(most) * static_cast<double>(1U << (shift / 2));
  const std::uint32_t bands = tiles_along(box.width, std::min(side, box.width));
  const double higher = shift % 2 == 0 ? side : 2.0 * side;
  const std::uint32_t groups = tiles_along(box.height, std::min(higher, box.height));
  const double width = box.width / bands;
  const double height = box.height / groups;
  grid.levels.clear();
  grid.tile_keys = 0;
  double radius = largest_radius;
  for (std::size_t k = 0; k < count.size(); ++k, radius /= class_ratio) {
    GridLevel level;
    level.largest_radius = radius;
    const double cell = cell_of(static_cast<double>(count[k]));
    level.band_shift = shift_for(width, cell);
    level.group_shift = shift_for(height, cell);
    level.columns = bands << level.band_shift;
    level.rows = groups << level.group_shift;
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
    level.group_keys = grid.tile_keys;
    level.band_keys = groups * grid.tile_keys;
  }
  grid.tiles = bands * groups;
  grid.keys = grid.tiles * grid.tile_keys;
}

}  // namespace carom
