// A tolerance for coordinates.
#pragma once

#include <cmath>

#include "core/disks/domain.hpp"

namespace carom {

// Rounding of decimals may put a touching disk this far beyond contact: 1e-12 of its radius, plus four units in the
// last place of `length`, the longer side of the box. All are lengths.
inline double place_slack(double radius, double length) {
  return 1e-12 * radius + 0x1p-50 * length;
}
inline double place_slack(const Domain& box, double radius) {
  return place_slack(radius, std::fmax(box.width, box.height));
}

}  // namespace carom
