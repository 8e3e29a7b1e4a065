// The distance that disks may move from their listed positions, and the time that this takes.
#pragma once

#include <cmath>

#include "core/base/types.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// The distance that a disk may move from its listed position before it is relisted.
struct RelistDistance {
  double length = 0.0;
  double stay2 = never;  // the length squared, a little less
  double lead2 = 0.0;    // square of the most by which a disk is listed ahead of its position
};

// A disk is listed ahead of its position by at most this share of the relist distance, since it must be within that
// distance, less the most by which gravity may bend its path: otherwise relisting would be due at once, and again for
// ever.
inline constexpr double most_lead = 0.8;
// The most by which gravity or a flow may bend a path before it is checked again how long the disk stays listed, over
// the relist distance.
inline constexpr double bend_share = 0.1;
static_assert(most_lead < 1.0 - bend_share);

inline RelistDistance relist_distance_of(double length) {
  return {length, length * length * (1.0 - 2e-9), most_lead * most_lead * length * length};
}

// The time for which a point that is now at d and moves at velocity v stays within a distance of the origin; 0 if it is
// outside now. distance2: the distance squared.
inline double time_within(double distance2, Vec2 d, Vec2 v) {
  const double c = distance2 - (d.x * d.x + d.y * d.y);
  if (!(c > 0.0)) return 0.0;
  const double a = v.x * v.x + v.y * v.y;
  if (a == 0.0) return never;
  const double b = d.x * v.x + d.y * v.y;
  const double root = std::sqrt(b * b + a * c);
  return b > 0.0 ? c / (b + root) : (root - b) / a;
}

}  // namespace carom
