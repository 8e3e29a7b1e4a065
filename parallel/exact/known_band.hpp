// The band of the box in which a rank, or a part of the box, has all disks.
#pragma once

#include <cmath>

namespace carom {

// The coordinates c along an axis (the y axis for ranks) with below <= c - centre <= above, for the nearest image along
// a period; lengths. Without bounds it is the whole box.
struct KnownBand {
  double centre = 0.0;
  double period = 0.0;  // 0: none
  double below = -HUGE_VAL, above = HUGE_VAL;

  // c minus the centre, of the nearest image. Precondition: c is in the box, or outside by less than a third of a
  // period.
  double from_centre(double c) const {
    const double d = c - centre;
    const double turn = std::abs(d) > 0.5 * period ? period : 0.0;
    return d > 0.0 ? d - turn : d + turn;
  }
  // Is everything within this distance of a coordinate in the band?
  bool holds(double c, double distance) const {
    if (below == -HUGE_VAL && above == HUGE_VAL) [[likely]]
      return true;
    const double d = from_centre(c);
    return d - distance >= below && d + distance <= above;
  }
};

}  // namespace carom
