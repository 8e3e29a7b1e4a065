#include "parallel/cells/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

// So many cells must be left out that a disk outside the stored cells is nearer to one end of them than to the other.
constexpr std::int64_t least_left_out = 2;

// In a grid: kernels read keys as signed numbers of 32 bits, and a level of one row has two keys a cell.
constexpr double most_cells = 1e9;
constexpr double cells_a_disk = 2.0;
// If disks crowd: the largest factor for the number of cells, and the largest number of cells with it; each sort clears
// and scans all cells.
constexpr double most_crowding = 64.0;
constexpr double most_cells_when_crowded = 0x1p24;

std::uint32_t cells_of_side(double length, double least, double most, bool periodic) {
  const double cells = cells_along(length, least, most);
  return periodic && cells < 3.0 ? 1 : static_cast<std::uint32_t>(cells);
}

// The smallest cell with which every neighbour is still found.
double least_cell(double radius, double margin) {
  return 2.0 * radius + 2.0 * (margin * 2.0 * radius);
}

// The cells between two places along a side, in units of cells, or all of them.
StoredCells stored_between(double low, double high, std::uint32_t cells_of_side, bool periodic) {
  const std::int64_t cells = cells_of_side;
  const auto cell_at = [&](double at) {
    const auto cell = static_cast<std::int64_t>(std::floor(at));
    return periodic ? cell : std::clamp<std::int64_t>(cell, 0, cells - 1);
  };
  const std::int64_t first = cell_at(low);
  const std::int64_t count = cell_at(high) - first + 1;
  if (count + least_left_out > cells) return {};
  return {static_cast<std::uint32_t>((first % cells + cells) % cells), static_cast<std::uint32_t>(count)};
}

// The largest number of cells for this number of disks.
double cells_for(double disks, double crowding) {
  const double spread = cells_a_disk * disks + 1.0;
  return std::max(spread, std::min(spread * std::min(crowding, most_crowding), most_cells_when_crowded));
}

}  // namespace

void count_classes(const Disks& d, double largest_radius, std::vector<std::size_t>& count) {
  count.assign(d.empty() ? 1 : class_of_radius(smallest_radius(d), largest_radius) + 1, 0);
  if (d.radius.empty() || count.size() == 1) {
    count.back() = d.size();
    return;
  }
  for (const double r : d.radius) ++count[class_of_radius(r, largest_radius)];
}

std::vector<std::size_t> count_classes(const Disks& d, double largest_radius) {
  std::vector<std::size_t> count;
  count_classes(d, largest_radius, count);
  return count;
}

void make_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count, CellGrid& grid,
               double margin, double crowding) {
  grid.levels.clear();
  grid.keys = 0;
  grid.tiles = grid.tiles_a_layer = 1;
  grid.tile_keys = 0;
  const double most_cells_a_level = most_cells / static_cast<double>(count.size());
  double radius = largest_radius;
  for (std::size_t k = 0; k < count.size(); ++k, radius /= class_ratio) {
    GridLevel level;
    level.largest_radius = radius;
    level.margin = margin * 2.0 * radius;
    const double least = least_cell(radius, margin);
    // Divided between the two directions in the ratio of the box's sides.
    const double cells = std::min(cells_for(static_cast<double>(count[k]), crowding), most_cells_a_level);
    const double across = std::sqrt(cells * box.width / box.height);
    level.columns = cells_of_side(box.width, least, std::clamp(across, 1.0, cells), box.periodic_x());
    level.rows = cells_of_side(box.height, least, cells / std::min<double>(level.columns, cells), box.periodic_y());
    level.kept_rows = level.rows;
    level.cell_width = box.width / level.columns;
    level.cell_height = box.height / level.rows;
    level.columns_per_length = level.columns / box.width;
    level.rows_per_length = level.rows / box.height;
    level.stride = level.columns + 1;
    level.first_key = grid.keys;
    grid.keys += level.keys();
    grid.levels.push_back(level);
  }
}

bool is_bounded_by_disks(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                         double margin) {
  double radius = largest_radius;
  for (const std::size_t disks : count) {
    const double least = least_cell(radius, margin);
    if (cells_for(static_cast<double>(disks), 1.0) < box.width / least * (box.height / least)) return true;
    radius /= class_ratio;
  }
  return false;
}

void keep_rows(CellGrid& grid, double low, double high) {
  grid.keys = 0;
  for (GridLevel& level : grid.levels) {
    level.first_row = row_at(level, low);
    level.kept_rows = row_at(level, high) - level.first_row + 1;
    level.first_key = grid.keys - level.first_row * level.stride;
    grid.keys += level.keys();
  }
}

void store_cells_between(const Domain& box, Vec2 low, Vec2 high, CellGrid& grid) {
  grid.keys = 0;
  for (GridLevel& level : grid.levels) {
    if (low.y < high.y) {
      level.stored_rows =
          stored_between(low.y * level.rows_per_length, high.y * level.rows_per_length, level.rows, box.periodic_y());
      level.kept_rows = std::min(level.rows, level.stored_rows.count);
    }
    if (low.x < high.x) {
      level.stored_columns = stored_between(low.x * level.columns_per_length, high.x * level.columns_per_length,
                                            level.columns, box.periodic_x());
      level.stride = std::min(level.columns, level.stored_columns.count) + 1;
    }
    level.first_key = grid.keys;
    grid.keys += level.keys();
  }
}

CellGrid make_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count) {
  CellGrid grid;
  make_grid(box, largest_radius, count, grid);
  return grid;
}

}  // namespace carom
