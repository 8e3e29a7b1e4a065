// A test whether a disk touches a wall, with the kinds of sides evaluated once for all disks.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"

namespace carom {

// Are there walls or obstacles?
inline bool has_walls(const Domain& box) {
  return box.has(SideKind::wall) || box.obstacles != nullptr;
}

// For each side, the value of reach_beyond (core/physics/boundary.hpp) from which on a disk touches it: 0 for a wall,
// negative for a wall that has moved into the box, infinity for other sides.
class WallReach {
 public:
  explicit WallReach(const Domain& box) : width_(box.width), height_(box.height), obstacles_(box.obstacles) {
    for (Side side : all_sides) {
      least_[static_cast<std::size_t>(side)] =
          box.side(side) == SideKind::wall ? -box.place(side).inset : std::numeric_limits<double>::infinity();
    }
    // With obstacles every disk passes the first test, so that scenes without obstacles need no further one.
    first_left_ = obstacles_ == nullptr ? least_[0] : -std::numeric_limits<double>::infinity();
  }

  const std::array<double, 4>& least() const { return least_; }

  // Does a disk of radius r at (x, y) touch or overlap a wall, or may it touch an obstacle?
  bool touches(double x, double y, double r) const {
    const bool other = ((x + r) - width_ >= least_[1]) | (r - y >= least_[2]) | ((y + r) - height_ >= least_[3]);
    if (!(other | (r - x >= first_left_))) return false;
    return obstacles_ == nullptr || other || r - x >= least_[0] || r > obstacles_->clearance({x, y});
  }

 private:
  double width_, height_;  // length
  const ObstacleCells* obstacles_;
  std::array<double, 4> least_{};  // in the order of Side; length
  double first_left_ = 0.0;
};

}  // namespace carom
