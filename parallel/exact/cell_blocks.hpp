// The cells of rows and columns, as blocks of regular strides in memory.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

// Is every stored row in this span, which may go on at the other end of the box?
inline bool has_stored_rows(const GridLevel& level, Span rows) {
  const std::uint32_t first = level.first_stored;
  const std::uint32_t ahead = first >= rows.first ? first - rows.first : level.rows - rows.first + first;
  return ahead + level.stored_rows <= rows.count;
}

// For a span of rows of the box, the places of the rows among those that are stored. Where the span reaches from rows
// nearer to the last stored row to rows nearer to the first, it is all stored rows: disks may have flown there, and of
// two that are near each other each must find the other. So it is where the span has them all: its last row may lie
// nearer, round the box, to the first one stored.
inline Span stored_span(const GridLevel& level, Span rows) {
  if (rows.count == level.rows) return {0, std::min(level.rows, level.stored_rows)};
  if (level.stored_rows >= level.rows) return rows;
  if (has_stored_rows(level, rows)) return {0, level.stored_rows};
  const std::uint32_t end = rows.first + rows.count - 1;
  const std::uint32_t first = level.place_of_row(rows.first);
  const std::uint32_t last = level.place_of_row(end < level.rows ? end : end - level.rows);
  return last >= first ? Span{first, last - first + 1} : Span{0, level.stored_rows};
}

// Calls visit(block) for blocks that together are the cells of these rows and columns of a level.
template <class Visit>
void for_each_cell_block(const GridLevel& level, Span rows, Span columns, Visit&& visit) {
  for (std::uint32_t left = columns.count, column = columns.first; left > 0;) {
    // Up to the end of the band or of the box.
    const std::uint32_t width = std::min({left, level.columns - column, level.columns_left_in_band(column)});
    const std::uint32_t column_key = level.first_key + level.key_of_column(column);
    for (std::uint32_t above = rows.count, row = rows.first; above > 0;) {
      const std::uint32_t height = std::min({above, level.rows - row, level.end_of_group(row) - row});
      visit(CellBlock{column_key + level.key_of_row(row), width, height, level.stride});
      above -= height;
      row = row + height < level.rows ? row + height : 0;
    }
    left -= width;
    column = column + width < level.columns ? column + width : 0;
  }
}

// The cell that follows the last one of a block.
inline std::uint32_t end_of(const CellBlock& block) {
  return block.first + (block.rows - 1) * block.stride + block.width;
}

// Calls visit(first, last) for the cells [first, last) of each row of a block.
template <class Visit>
void for_each_row(const CellBlock& block, Visit&& visit) {
  std::uint32_t first = block.first;
  for (std::uint32_t left = block.rows; left > 0; --left, first += block.stride) visit(first, first + block.width);
}

}  // namespace carom
