// A map of lower bounds on the distance from all obstacles, one for each cell: a disk that is far from them needs one
// look-up only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/cell_axis.hpp"
#include "core/disks/domain.hpp"

namespace carom {

class Clearance {
 public:
  // All places within `radius` (length) of a segment, or of a point where `along` is 0. It may reach across periodic
  // sides.
  struct Shape {
    Vec2 from, along;
    double radius = 0.0;
  };
  // A rectangle.
  struct Extent {
    Vec2 low, high;  // length
  };
  Clearance() = default;
  // The map of these shapes, or rectangles, in about so many cells.
  Clearance(const Domain& box, const std::vector<Shape>& shapes, std::size_t cells);
  Clearance(const Domain& box, const std::vector<Extent>& extents, std::size_t cells);

  // Until the next call, all shapes are displaced by an unknown vector between `low` and `high`; length. Precondition:
  // they do not cross sides that are not periodic.
  void displace(Vec2 low, Vec2 high);

  // Every shape is at least this far from the place; length. Negative where nothing is known, as beyond the sides.
  double at(Vec2 place) const {
    const bool in_box = place.x >= 0.0 && place.y >= 0.0 && place.x < x_.length && place.y < y_.length;
    if (!in_box) return -HUGE_VAL;
    // The place as the undisplaced shapes see it. If it lies beyond a side that is not periodic, the place at that side
    // is taken instead: nothing in the box is further from that.
    const std::int64_t column = cell_of(place.x - shift_.x, x_);
    const std::int64_t row = cell_of(place.y - shift_.y, y_);
    return step_ * static_cast<double>(steps_[static_cast<std::size_t>(row * x_.cells + column)]) - blur_;
  }
  // Does no shape reach into the rectangle? The answer may be a wrong no, never a wrong yes.
  bool is_clear(Vec2 low, Vec2 high) const {
    const double x = 0.5 * (high.x - low.x);
    const double y = 0.5 * (high.y - low.y);
    return std::sqrt(x * x + y * y) <= at({0.5 * (low.x + high.x), 0.5 * (low.y + high.y)});
  }

  // The data of at(), for vector kernels that compute the same.
  struct Cells {
    const std::uint8_t* steps = nullptr;
    double columns = 0.0, rows = 0.0;
    double columns_per_length = 0.0, rows_per_length = 0.0;
    Vec2 size, period;              // of the box; period: 0 along an axis that is not periodic; length
    Vec2 shift;                     // length
    double step = 0.0, blur = 0.0;  // length
  };
  Cells cells() const;

 private:
  void lay_cells(const Domain& box, std::size_t cells);
  void enter_shape(const Shape& shape, std::vector<double>& nearest) const;
  void enter_extent(Extent extent, std::vector<double>& nearest) const;
  template <class Distance>
  void enter(const Extent& extent, Distance&& distance, std::vector<double>& nearest) const;
  std::vector<std::uint8_t> rings_around(const std::vector<double>& nearest) const;
  void store_bounds(const std::vector<double>& nearest);

  // The cell of a coordinate, which lies in the box, less than a period before it, or beyond a side that is not
  // periodic.
  static std::int64_t cell_of(double c, const CellAxis& axis) {
    if (c < 0.0 && axis.periodic) c += axis.length;
    const double last = static_cast<double>(axis.cells - 1);
    return static_cast<std::int64_t>(std::clamp(c * axis.cells_per_length, 0.0, last));
  }

  CellAxis x_, y_;
  double cell_ = 0.0;           // the shorter side of a cell; length
  double half_diagonal_ = 0.0;  // of a cell; length
  double step_ = 0.0;           // length
  Vec2 shift_{};                // mean displacement of the shapes, within one period; length
  double blur_ = 0.0;           // uncertainty of that displacement; length
  // For each cell, row by row: the distance of the whole cell from all shapes in units of step_, rounded down.
  std::vector<std::uint8_t> steps_;
};

}  // namespace carom
