// The cells into which the disks are sorted: one grid for each size class, rows of cells contiguous in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/cell_index.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// The distance that a disk may leave its cell by and still be found there, over the largest diameter of its size class.
// With a larger margin disks are sorted less often, but every search tests more of them. Time stepping uses twice this
// value, since it tests eight disks at a time.
inline constexpr double grid_margin = 0.1;

// Radii of one class differ by less than this factor, so that no cell holds many disks, however mixed the sizes are.
inline constexpr double class_ratio = 2.0;

// The cells along a side that are stored: a number of them from the first one on, possibly round the box; if all are
// stored, count is the largest possible number.
struct StoredCells {
  std::uint32_t first = 0, count = 0xffffffffU;

  // The place among the stored cells of a cell along a side with this number of cells; if it is not stored, that of the
  // nearest one that is.
  std::uint32_t place_of(std::uint32_t cell, std::uint32_t cells) const {
    const std::uint32_t place = cell - first;
    return place < count ? place : place_round_the_box(place, cells);
  }

 private:
  // place: the cell less the first one, modulo 2^32.
  std::uint32_t place_round_the_box(std::uint32_t place, std::uint32_t cells) const {
    if (place >= cells) place += cells;
    if (place < count) return place;
    return place < count + (cells - count) / 2 ? count - 1 : 0;
  }
};

// The grid of one size class. The cell in a row and a column has the key first_key + row * stride + column. Each row
// ends in one empty cell, and one empty row follows the last, so that the neighbours of every cell can be looked up
// whatever its position. If only some rows are kept (keep_rows), first_key is before the first key in use, modulo 2^32,
// so that keys give the row in the box. If only some rows and columns are stored (store_cells_between), keys give the
// places among those. A tiled level is cut into bands of 2^band_shift columns and groups of 2^group_shift rows, without
// the empty cells; a tile is the intersection of a band and a group.
struct GridLevel {
  double largest_radius = 0.0;                 // of the class; length
  double cell_width = 0.0;                     // length
  double cell_height = 0.0;                    // length
  double columns_per_length = 0.0;             // 1 / cell_width
  double rows_per_length = 0.0;                // 1 / cell_height
  double margin = 0.0;                         // length by which a disk may leave its cell
  std::uint32_t columns = 1, rows = 1;         // of the whole box
  std::uint32_t first_row = 0, kept_rows = 1;  // rows that have cells
  std::uint32_t stride = 2;
  std::uint32_t first_key = 0;
  unsigned band_shift = 31;   // columns in a band: 2^band_shift
  unsigned group_shift = 31;  // rows in a group: 2^group_shift
  std::uint32_t band_keys = 0, group_keys = 0;
  StoredCells stored_rows, stored_columns;

  // For a level that is not tiled: the number of its keys, and the first key.
  std::uint32_t keys() const { return (kept_rows + 1) * stride + 2; }
  std::uint32_t start_key() const { return first_key + first_row * stride; }
  bool has_row(std::uint32_t row) const { return row - first_row < kept_rows; }
  // The key of a cell of the box, or of the nearest stored cell.
  std::uint32_t stored_key(std::uint32_t row, std::uint32_t column) const {
    return key_at(stored_rows.place_of(row, rows), stored_columns.place_of(column, columns));
  }
  std::uint32_t columns_left_in_band(std::uint32_t column) const {
    return (1U << band_shift) - (column & ((1U << band_shift) - 1U));
  }
  // What a row and a column add to first_key.
  std::uint32_t key_of_row(std::uint32_t row) const {
    return (row >> group_shift) * group_keys + (row & ((1U << group_shift) - 1U)) * stride;
  }
  // The row behind the last one of this row's group.
  std::uint32_t end_of_group(std::uint32_t row) const { return ((row >> group_shift) + 1U) << group_shift; }
  std::uint32_t key_of_column(std::uint32_t column) const {
    return (column >> band_shift) * band_keys + (column & ((1U << band_shift) - 1U));
  }
  std::uint32_t key_at(std::uint32_t row, std::uint32_t column) const {
    return first_key + key_of_row(row) + key_of_column(column);
  }
};

struct CellGrid {
  std::vector<GridLevel> levels;  // from the largest disks to the smallest
  std::uint32_t keys = 0;         // of all levels
  std::uint32_t tiles = 1;
  std::uint32_t tiles_a_layer = 1;  // neighbours in memory, from one side of the box to the other
  std::uint32_t tile_keys = 0;      // keys of all levels in a tile, which are neighbours in memory; 0: not tiled
};

// Size class k holds radii r with largest / 2^(k+1) < r <= largest / 2^k. Precondition: radius > 0.
inline std::size_t class_of_radius(double radius, double largest_radius) {
  std::size_t k = 0;
  for (double r = radius * class_ratio; r <= largest_radius; r *= class_ratio) ++k;
  return k;
}

// The number of disks in each size class, up to that of the smallest disk; at least one class. Precondition: no radius
// is above largest_radius.
void count_classes(const Disks& disks, double largest_radius, std::vector<std::size_t>& count);
std::vector<std::size_t> count_classes(const Disks& disks, double largest_radius);

// Makes a level for each size class; count[k] is the number of disks of class k. A level's cells are at least a
// diameter and two margins wide. There are not many more cells than disks, unless these crowd (`crowding`:
// crowding.hpp): then there are more in proportion. If fewer than three cells would fit along a period there is one,
// which is its own neighbour. margin: as grid_margin. The memory of grid is reused.
void make_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count, CellGrid& grid,
               double margin = grid_margin, double crowding = 1.0);
CellGrid make_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count);

// Would this grid have smaller cells if there were more disks? If not, crowding has no effect on it.
bool is_bounded_by_disks(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                         double margin = grid_margin);

// Keeps only the cells of disks between these heights: a disk elsewhere must not be sorted into the grid, and is found
// near no place. Preconditions: the grid is not tiled, and all its rows are kept.
void keep_rows(CellGrid& grid, double low, double high);

// Stores only the cells of the rectangle between these two places, which may extend across the sides of a periodic box.
// A disk elsewhere is put into the nearest stored row and column. All rows, or columns, stay if few would be removed,
// or if `low` is not below `high`. Preconditions as for keep_rows.
void store_cells_between(const Domain& box, Vec2 low, Vec2 high, CellGrid& grid);

inline std::uint32_t row_at(const GridLevel& level, double y) {
  return cell_index(y * level.rows_per_length, level.rows);
}
inline std::uint32_t key_of(const GridLevel& level, double x, double y) {
  return level.stored_key(row_at(level, y), cell_index(x * level.columns_per_length, level.columns));
}

}  // namespace carom
