// The contiguous runs of disks within reach of a place: one for each row of cells, or two if the cells continue at the
// other end of the row.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Consecutive cells along one side; along a period they continue at its other end.
struct Span {
  std::uint32_t first = 0, count = 0;
};

// A bound on the rounding of a distance, over the side of the box.
inline constexpr double span_rounding = 1e-12;

// The cells of all disks whose coordinate was within reach of c when they were sorted, in spite of rounding also of
// those that were exactly as far: in a lattice of touching disks that move together, many are.
inline Span span_around(double c, double reach, double length, double per_length, std::uint32_t cells, bool periodic) {
  reach += span_rounding * length;
  // If the two ends come within a cell of each other along the period, the whole side is taken once.
  if (cells == 1 || (2.0 * reach) * per_length + 2.0 >= cells) return {0, cells};
  double low = c - reach;
  double high = c + reach;
  if (periodic && low < 0.0) low += length;
  if (periodic && high >= length) high -= length;
  const std::uint32_t first = cell_index(low * per_length, cells);
  const std::uint32_t last = cell_index(high * per_length, cells);
  return {first, last >= first ? last - first + 1 : cells - first + last + 1};
}

// visit(first, last) for each run [first, last) of disks of one level within reach (length) of (x, y).
template <class Visit>
void for_each_run_near(const GridLevel& level, const std::uint32_t* start, const Domain& box, double x, double y,
                       double reach, Visit&& visit) {
  const Span rows = span_around(y, reach, box.height, level.rows_per_length, level.rows, box.periodic_y());
  Span columns = span_around(x, reach, box.width, level.columns_per_length, level.columns, box.periodic_x());
  // Across the bottom or the top of a sheared box, neighbours may be in any column; the same margin as in span_around.
  const double seen = reach + span_rounding * box.height;
  if (box.shear.acts() && (y < seen || y >= box.height - seen || rows.count == level.rows)) [[unlikely]]
    columns = {0, level.columns};
  const std::uint32_t straight = std::min(columns.count, level.columns - columns.first);
  for (std::uint32_t k = 0; k < rows.count; ++k) {
    const std::uint32_t row = rows.first + k < level.rows ? rows.first + k : rows.first + k - level.rows;
    if (!level.has_row(row)) continue;
    const std::uint32_t row_key = level.first_key + row * level.stride;
    visit(start[row_key + columns.first], start[row_key + columns.first + straight]);
    if (straight < columns.count) visit(start[row_key], start[row_key + columns.count - straight]);
  }
}

}  // namespace carom
