// Where the disks are that a rank, or a part of the box, has.
#pragma once

#include <cmath>

namespace carom {

// The coordinates c along an axis, that of y for ranks, with below <= c - centre <= above, nearest images along a
// period; lengths. Without bounds, all of the box.
struct KnownBand {
  double centre = 0.0;
  double period = 0.0;  // 0: none
  double below = -HUGE_VAL, above = HUGE_VAL;

  // Precondition: c is in the box, or out of it by less than a third of a period.
  double from_centre(double c) const {
    const double d = c - centre;
    const double turn = std::abs(d) > 0.5 * period ? period : 0.0;
    return d > 0.0 ? d - turn : d + turn;
  }
  // Is all within this distance of a coordinate in the band?
  bool holds(double c, double distance) const {
    if (below == -HUGE_VAL && above == HUGE_VAL) [[likely]]
      return true;
    const double d = from_centre(c);
    return d - distance >= below && d + distance <= above;
  }
};

}  // namespace carom
