// The cells that contain listed positions.
#pragma once

#include <algorithm>
#include <cstdint>

#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/list_kernel.hpp"
#include "parallel/exact/list_row.hpp"

namespace carom {

// The cell, of this number of cells along a side, for disks that are listed at a coordinate. at: in units of 2^-32 of a
// period or 2^-31 of a side between walls.
inline std::uint32_t cell_of_listed(std::uint32_t at, std::uint32_t cells, bool periodic) {
  const auto k = static_cast<std::uint32_t>(std::uint64_t{at} * cells >> (periodic ? 32U : 31U));
  return std::min(k, cells - 1);  // a place on the far wall itself is in the last cell
}

// Do the two ends of a reach come within a cell of each other along the period? Then the whole side is taken once.
inline bool takes_whole_side(std::uint32_t reach, std::uint32_t cells, bool periodic) {
  return cells <= 2 || 2 * std::uint64_t{reach} * cells >= std::uint64_t{cells - 2} << (periodic ? 32U : 31U);
}

// The cells of the disks that are listed within reach of a coordinate.
inline Span span_around_listed(std::uint32_t at, std::uint32_t reach, std::uint32_t cells, bool periodic) {
  if (takes_whole_side(reach, cells, periodic)) return {0, cells};
  const std::uint32_t low = periodic || at > reach ? at - reach : 0;
  const std::uint32_t first = cell_of_listed(low, cells, periodic);
  const std::uint32_t last = cell_of_listed(at + reach, cells, periodic);
  return {first, last >= first ? last - first + 1 : cells - first + last + 1};
}

// The cells along one side, of which possibly only those of a part are stored.
struct ListedAxis {
  std::int64_t cells = 1;
  unsigned bits = 32;        // the side is 2^bits units of listed positions long
  bool may_be_whole = true;  // may a search take the whole side?
  std::int64_t first_stored = 0, stored = 1;

  // The places, among the stored cells, of the cells within reach of a coordinate, if all of these are stored and do
  // not continue at the other end of the side; otherwise none.
  Span span_around(std::uint32_t at, std::uint32_t reach) const {
    if (may_be_whole && takes_whole_side(reach, static_cast<std::uint32_t>(cells), bits == 32U)) [[unlikely]]
      return {0, static_cast<std::uint32_t>(stored)};
    const std::int64_t first = (std::int64_t{at} - reach) * cells >> bits;
    const std::int64_t last = (std::int64_t{at} + reach) * cells >> bits;
    const std::int64_t from_stored = first - first_stored;
    const std::int64_t place = from_stored < 0 ? from_stored + cells : from_stored;
    const std::int64_t count = last - first + 1;
    if (first < 0 || last >= cells || place + count > stored) [[unlikely]]
      return {0, 0};
    return {static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(count)};
  }
  // The place, among the stored cells, of the cell at a coordinate; not less than `stored` if it is not stored.
  std::int64_t place_of(std::uint32_t at) const {
    // The far wall itself is in the last cell.
    const std::int64_t place = std::min(std::int64_t{at} * cells >> bits, cells - 1) - first_stored;
    return place < 0 ? place + cells : place;
  }
};

// The reach of a search for neighbours, in units of listed positions.
struct ListReach {
  std::uint32_t x = 0, y = 0;
};

// A level of the grid. With tiles, cells are found in another way, and no cell counts as stored here.
struct ListedLevel {
  ListedAxis columns, rows;
  std::uint32_t first_key = 0, stride = 0;
  double largest_radius = 0.0;  // length
  std::uint32_t cell(std::int64_t row, std::int64_t column) const {
    return first_key + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
  }
  // The cells within reach, if they form one block; otherwise a block without cells.
  CellBlock block_around(FixedPointPosition at, ListReach reach) const {
    const Span y = rows.span_around(at.y, reach.y);
    const Span x = columns.span_around(at.x, reach.x);
    return {cell(y.first, x.first), x.count, x.count > 0 ? y.count : 0, stride};
  }
};

}  // namespace carom
