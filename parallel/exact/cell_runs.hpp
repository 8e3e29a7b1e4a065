// The cells of rows and columns, as runs of neighbours in memory.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/nearby_runs.hpp"

namespace carom {

// For a span of rows of the box, the places of the rows among those that are stored. Where the span reaches from rows
// nearer to the last stored row to rows nearer to the first, it is all stored rows: disks may have flown there, and of
// two that are near each other each must find the other.
inline Span stored_span(const GridLevel& level, Span rows) {
  if (rows.count == level.rows) return {0, std::min(level.rows, level.stored_rows)};
  if (level.stored_rows >= level.rows) return rows;
  const std::uint32_t end = rows.first + rows.count - 1;
  const std::uint32_t first = level.place_of_row(rows.first);
  const std::uint32_t last = level.place_of_row(end < level.rows ? end : end - level.rows);
  return last >= first ? Span{first, last - first + 1} : Span{0, level.stored_rows};
}

// Calls visit(first, last) for runs of cells [first, last), contiguous in memory, that together are the cells of these
// rows and columns of a level.
template <class Visit>
void for_each_cell_run(const GridLevel& level, Span rows, Span columns, Visit&& visit) {
  for (std::uint32_t left = columns.count, column = columns.first; left > 0;) {
    // Up to the end of the band or of the row.
    const std::uint32_t band = std::min(level.columns - column, level.columns_left_in_band(column));
    const std::uint32_t run = std::min(left, band);
    const std::uint32_t column_key = level.first_key + level.key_of_column(column);
    std::uint32_t row = rows.first;
    std::uint32_t first = column_key + level.key_of_row(row);
    std::uint32_t stop = std::min(level.rows, level.end_of_group(row));
    for (std::uint32_t k = rows.count; k > 0; --k) {
      visit(first, first + run);
      first += level.stride;
      if (++row == stop) [[unlikely]] {
        row = row == level.rows ? 0 : row;
        first = column_key + level.key_of_row(row);
        stop = std::min(level.rows, level.end_of_group(row));
      }
    }
    left -= run;
    column = column + run < level.columns ? column + run : 0;
  }
}

}  // namespace carom
