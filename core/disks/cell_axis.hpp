// Cells along one side of the box. Across periodic sides their numbers go on: below 0, and above the number of cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

struct CellAxis {
  struct Span {
    std::int64_t first, last;  // cells
  };

  double length = 0.0;
  bool periodic = false;
  std::int64_t cells = 1;
  double cells_per_length = 1.0;

  // The cell of a coordinate; beyond a side that is not periodic, the outermost cell.
  std::int64_t cell_of(double c) const {
    const double cell = std::floor(c * cells_per_length);
    const double last = static_cast<double>(cells - 1);
    return static_cast<std::int64_t>(periodic ? cell : std::clamp(cell, 0.0, last));
  }
  // The cells from low to high, and a little further at both ends, since coordinates of images are rounded.
  Span span(double low, double high) const {
    const double slack = 1e-9 / cells_per_length;
    low -= slack;
    high += slack;
    if (low >= 0.0 && high < length) [[likely]] {
      // The product may be rounded up to the end of the box.
      const auto last = static_cast<std::int64_t>(high * cells_per_length);
      return {static_cast<std::int64_t>(low * cells_per_length), std::min(last, cells - 1)};
    }
    return {cell_of(low), cell_of(high)};
  }
  // The number of whole periods by which a cell lies beyond the box, rounded down.
  std::int64_t periods(std::int64_t cell) const {
    if (!periodic || (cell >= 0 && cell < cells)) [[likely]]
      return 0;
    return cell >= 0 ? cell / cells : -((cells - 1 - cell) / cells);
  }
  // The same cell in the box.
  std::int64_t in_box(std::int64_t cell) const { return cell - periods(cell) * cells; }
};

}  // namespace carom
