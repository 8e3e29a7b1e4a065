// How far from all obstacles a place is, at least: one number a cell, so that disks that are far from them ask for
// nothing else.
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
  // All places within `radius` of a segment, or of its beginning; length. Beyond periodic sides it reaches over them.
  struct Shape {
    Vec2 from, along;
    double radius = 0.0;
  };
  // A rectangle.
  struct Extent {
    Vec2 low, high;  // length
  };
  Clearance() = default;
  // Of what lies in the box, in about so many cells.
  Clearance(const Domain& box, const std::vector<Shape>& shapes, std::size_t cells);
  Clearance(const Domain& box, const std::vector<Extent>& extents, std::size_t cells);

  // All that it is made of is displaced, by no less than `low` and no more than `high` along each axis, until the next
  // call; length. Precondition: it stays in the box, but for periodic sides.
  void displace(Vec2 low, Vec2 high);

  // Nothing is nearer to this place; length, negative where it is not known. Not known beyond the sides.
  double at(Vec2 place) const {
    const bool in_box = place.x >= 0.0 && place.y >= 0.0 && place.x < x_.length && place.y < y_.length;
    if (!in_box) return -HUGE_VAL;
    // Where it would be if nothing were displaced. That may be beyond a side that is not periodic: then as at the side,
    // from which all that is in the box is no further.
    const std::int64_t column = cell_of(place.x - shift_.x, x_);
    const std::int64_t row = cell_of(place.y - shift_.y, y_);
    return step_ * static_cast<double>(steps_[static_cast<std::size_t>(row * x_.cells + column)]) - blur_;
  }
  // Is there nothing in the rectangle? May say no where there is nothing, never the other way round.
  bool is_clear(Vec2 low, Vec2 high) const {
    const double x = 0.5 * (high.x - low.x);
    const double y = 0.5 * (high.y - low.y);
    return std::sqrt(x * x + y * y) <= at({0.5 * (low.x + high.x), 0.5 * (low.y + high.y)});
  }

  // What at() reads, for a kernel that does the same.
  struct Cells {
    const std::uint8_t* steps = nullptr;
    double columns = 0.0, rows = 0.0;
    double columns_per_length = 0.0, rows_per_length = 0.0;
    Vec2 size, period;              // of the box; of its periodic sides, 0 of others; length
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

  // That of a coordinate less than a period before the box, or within it, or beyond sides that are not periodic.
  static std::int64_t cell_of(double c, const CellAxis& axis) {
    if (c < 0.0 && axis.periodic) c += axis.length;
    const double last = static_cast<double>(axis.cells - 1);
    return static_cast<std::int64_t>(std::clamp(c * axis.cells_per_length, 0.0, last));
  }

  CellAxis x_, y_;
  double cell_ = 0.0;           // the shorter side of a cell; length
  double half_diagonal_ = 0.0;  // of a cell; length
  double step_ = 0.0;           // length
  Vec2 shift_{};                // of all, in the box where that is periodic; length
  double blur_ = 0.0;           // all may be displaced by so much more or less; length
  // Of each cell, row by row: how many steps all of it is away from everything.
  std::vector<std::uint8_t> steps_;
};

}  // namespace carom
