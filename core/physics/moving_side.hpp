// A side that moves: a wall in whose frame disks are reflected. What it gives to the disks is its work.
#pragma once

#include <cmath>

#include "core/physics/boundary.hpp"

namespace carom {

// Speed towards the side, in its frame: of a disk and a side that stands at `place`. length / time.
inline double approach_speed(Side side, double vx, double vy, const SidePlace& place) {
  return outward_speed(side, vx, vy) + place.speed;
}

inline void set_outward_speed(Side side, double speed, double& vx, double& vy) {
  const double v = side == Side::left || side == Side::bottom ? -speed : speed;
  (side == Side::left || side == Side::right ? vx : vy) = v;
}

// A disk that approaches a moving side at `approach` > 0, in the side's frame, leaves it at `away` there. Returns the
// impulse per mass.
inline double rebound(Side side, const SidePlace& place, double approach, double away, double& vx, double& vy) {
  set_outward_speed(side, -place.speed - away, vx, vy);
  return approach + away;
}

// Acceleration towards the side, in its frame; length / time^2.
inline double approach_acceleration(Side side, const Gravity& g, const SidePlace& place) {
  return outward_acceleration(side, g) + place.acceleration;
}

// Time until a disk `gap` away from a side touches it, approaching at `speed` with this acceleration: the smaller root
// of speed t + acceleration t^2 / 2 = gap that is not negative, in forms that do not cancel; `HUGE_VAL` if there is
// none. A disk that overlaps by rounding counts as touching.
inline double time_to_approach(double gap, double speed, double acceleration) {
  const double distance = gap > 0.0 ? gap : 0.0;
  if (acceleration == 0.0) return speed > 0.0 ? distance / speed : HUGE_VAL;
  const double discriminant = speed * speed + 2.0 * acceleration * distance;
  if (acceleration > 0.0) {
    const double root = std::sqrt(discriminant);
    return speed > 0.0 ? 2.0 * distance / (speed + root) : (root - speed) / acceleration;
  }
  if (!(speed > 0.0) || discriminant < 0.0) return HUGE_VAL;
  return 2.0 * distance / (speed + std::sqrt(discriminant));
}

}  // namespace carom
