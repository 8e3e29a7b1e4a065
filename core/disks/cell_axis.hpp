// Cells along one side of the box, counted on across periodic sides.
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

  // That of a coordinate; beyond a side that is not periodic, the outermost one.
  std::int64_t cell_of(double c) const {
    const double cell = std::floor(c * cells_per_length);
    const double last = static_cast<double>(cells - 1);
    return static_cast<std::int64_t>(periodic ? cell : std::clamp(cell, 0.0, last));
  }
  // A little further at both ends, as coordinates of images are rounded.
  Span span(double low, double high) const {
    const double slack = 1e-9 / cells_per_length;
    return {cell_of(low - slack), cell_of(high + slack)};
  }
  // By how many periods a cell lies beyond the box, rounded down.
  std::int64_t periods(std::int64_t cell) const {
    return periodic ? (cell >= 0 ? cell / cells : -((cells - 1 - cell) / cells)) : 0;
  }
  // The same cell in the box.
  std::int64_t in_box(std::int64_t cell) const { return cell - periods(cell) * cells; }
};

}  // namespace carom
