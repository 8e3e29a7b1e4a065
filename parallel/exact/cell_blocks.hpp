// The cells of rows and columns, as blocks of regular strides in memory.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

// Does this span contain all stored cells? cells: along the side, at whose other end the span may continue.
inline bool has_all_stored(StoredCells stored, std::uint32_t cells, Span span) {
  const std::uint32_t ahead =
      stored.first >= span.first ? stored.first - span.first : cells - span.first + stored.first;
  return ahead + stored.count <= span.count;
}

// For a span of cells along a side: the places of its cells among the stored ones. If the span reaches from cells
// nearer to the last stored one to cells nearer to the first, the result is all stored cells: disks may have flown
// there, and of two disks near each other each must find the other. The result is also all stored cells if the span
// contains them all: its last cell may be nearer, round the box, to the first one stored.
inline Span stored_span(StoredCells stored, std::uint32_t cells, Span span) {
  if (span.count == cells) return {0, std::min(cells, stored.count)};
  if (stored.count >= cells) return span;
  if (has_all_stored(stored, cells, span)) return {0, stored.count};
  const std::uint32_t end = span.first + span.count - 1;
  const std::uint32_t first = stored.place_of(span.first, cells);
  const std::uint32_t last = stored.place_of(end < cells ? end : end - cells, cells);
  return last >= first ? Span{first, last - first + 1} : Span{0, stored.count};
}

// Calls visit(block) for blocks that together are the cells of these rows and columns of a level, which are spans of
// stored cells.
template <class Visit>
void for_each_cell_block(const GridLevel& level, Span rows, Span columns, Visit&& visit) {
  for (std::uint32_t left = columns.count, column = columns.first; left > 0;) {
    // Up to the end of the band, or of the box.
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

// The same for rows and columns of the box, of which not all may be stored.
template <class Visit>
void for_each_stored_block(const GridLevel& level, Span rows, Span columns, Visit&& visit) {
  for_each_cell_block(level, stored_span(level.stored_rows, level.rows, rows),
                      stored_span(level.stored_columns, level.columns, columns), visit);
}

// The cell behind the last one of a block.
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
