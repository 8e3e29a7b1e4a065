// How far from all obstacles a place is, at least: one number a cell, so that disks that are far from them ask for
// nothing else.
#pragma once

#include <algorithm>
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

  // Is there nothing in the rectangle? May say no where there is nothing, never the other way round.
  bool is_clear(Vec2 low, Vec2 high) const {
    const double half = 0.5 * std::max((high.x - low.x) * x_.cells_per_length, (high.y - low.y) * y_.cells_per_length);
    return half <= cells_around({0.5 * (low.x + high.x), 0.5 * (low.y + high.y)});
  }
  // Nothing is nearer to this place along either side; length, negative where it is not known.
  double at(Vec2 place) const { return cells_around(place) * cell_; }

  // What at() reads, for a kernel that does the same.
  struct Cells {
    const std::uint8_t* away = nullptr;  // null: there are none
    double columns = 0.0, rows = 0.0;
    double columns_per_length = 0.0, rows_per_length = 0.0;
    double cell = 0.0;   // length
    double share = 0.0;  // of the cells away, without the one that the place is in, that count
  };
  Cells cells() const {
    return {away_.data(),
            static_cast<double>(x_.cells),
            static_cast<double>(y_.cells),
            x_.cells_per_length,
            y_.cells_per_length,
            cell_,
            share};
  }

 private:
  void begin(const Domain& box, std::size_t cells);
  void mark_shape(const Shape& shape);
  void mark_all(Extent extent);
  template <class Occupied>
  void mark(const Extent& extent, Occupied&& occupied);
  void spread();

  // So many cells of either axis. Not known beyond the sides.
  double cells_around(Vec2 place) const {
    const double x = place.x * x_.cells_per_length;
    const double y = place.y * y_.cells_per_length;
    const bool in_box = x >= 0.0 && y >= 0.0 && x < static_cast<double>(x_.cells) && y < static_cast<double>(y_.cells);
    if (!in_box) return -1.0;
    const auto cell = static_cast<std::size_t>(static_cast<std::int64_t>(y) * x_.cells + static_cast<std::int64_t>(x));
    // The place may be at its cell's border.
    return share * (static_cast<double>(away_[cell]) - 1.0);
  }

  static constexpr std::uint8_t furthest = 255;
  static constexpr double share = 1.0 - 1e-6;  // a little less, as places are rounded
  CellAxis x_, y_;
  double cell_ = 0.0;  // the shorter side of a cell; length
  // Of each cell, row by row: how many cells away, along either side, the nearest one is that something reaches into.
  std::vector<std::uint8_t> away_;
};

}  // namespace carom
