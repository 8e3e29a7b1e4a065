// A moving side: a wall that reflects disks in its own frame. The energy that it gives to them is its work.
#pragma once

#include <cmath>

#include "core/physics/boundary.hpp"

namespace carom {

// Speed of a disk towards the side in the frame of the side; length / time.
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

// Acceleration of a disk towards the side in the frame of the side; length / time^2.
inline double approach_acceleration(Side side, const Gravity& g, const SidePlace& place) {
  return outward_acceleration(side, g) + place.acceleration;
}

// Time until a disk `gap` away from a side touches it: the smallest root >= 0 of speed t + acceleration t^2 / 2 = gap,
// in forms that do not cancel; HUGE_VAL if there is none. speed, acceleration: towards the side. A disk that overlaps
// by rounding counts as touching.
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
