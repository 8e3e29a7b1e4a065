// What rounding may do to a place.
#pragma once

#include <cmath>

#include "core/disks/domain.hpp"

namespace carom {

// Rounding of decimals may put a disk that touches something this far beyond it: 1e-12 of its radius, and four units
// in the last place of the box, whose longer side this is. Lengths.
inline double place_slack(double radius, double length) {
  return 1e-12 * radius + 0x1p-50 * length;
}
inline double place_slack(const Domain& box, double radius) {
  return place_slack(radius, std::fmax(box.width, box.height));
}

}  // namespace carom
