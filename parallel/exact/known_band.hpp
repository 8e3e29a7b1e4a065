// On one of several ranks: the part of the box whose disks it has.
#pragma once

#include <cmath>

namespace carom {

// All heights y with below <= y - centre <= above, nearest images along a period; lengths. Without bounds, all of the
// box.
struct KnownBand {
  double centre = 0.0;
  double period = 0.0;  // 0: none
  double below = -HUGE_VAL, above = HUGE_VAL;

  double from_centre(double y) const {
    const double d = y - centre;
    return period > 0.0 ? d - period * std::round(d / period) : d;
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
