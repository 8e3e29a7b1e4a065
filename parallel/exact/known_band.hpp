// Where the disks are that a rank, or a part of the box, has.
#pragma once

#include <cmath>

namespace carom {

// The coordinates c (y, or x where parts follow each other along x) with below <= c - centre <= above, nearest images
// along a period; lengths. Without bounds, all of the box.
struct KnownBand {
  double centre = 0.0;
  double period = 0.0;  // 0: none
  double below = -HUGE_VAL, above = HUGE_VAL;

  // Precondition: y is in the box, or out of it by less than a third of a period.
  double from_centre(double y) const {
    const double d = y - centre;
    const double turn = std::abs(d) > 0.5 * period ? period : 0.0;
    return d > 0.0 ? d - turn : d + turn;
  }
  // Is all within this distance of height y in the band?
  bool holds(double y, double distance) const {
    if (below == -HUGE_VAL && above == HUGE_VAL) [[likely]]
      return true;
    const double d = from_centre(y);
    return d - distance >= below && d + distance <= above;
  }
};

}  // namespace carom
