// The exact method: when a path touches a side that vibrates as a sine. No closed form exists. The search advances in
// steps that cannot contain a contact, because a parabola, with a bound on the curvature, lies below the gap. So the
// first contact is never missed, however close the next ones are.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/physics/moving_side.hpp"

namespace carom {

struct SwingingSide {
  const SideMotion& motion;
  SidePlace now;  // at the start of the path
};

// A path and the side at one moment.
struct Swing {
  double gap;           // length, < 0: beyond the side
  double speed;         // towards it, in its frame
  double acceleration;  // likewise
};

// A bound on the acceleration towards the side for time h after a Swing. jerk: bound on its rate of change, amplitude
// w^3; most: bound on the acceleration itself.
inline double largest_acceleration(const Swing& swing, double h, double jerk, double most) {
  return std::min(most, swing.acceleration + jerk * h);
}

// The state of a search for the first contact with a vibrating side or wall: the time reached, and the longest next
// step.
struct SwingSearch {
  double period;
  double t = 0.0;
  double longest = 0.125 * period;

  // Advances t, at which `swing` holds, as far as there is certainly no contact. Returns false if there is contact at
  // t. jerk, most: as in largest_acceleration.
  bool go_on(const Swing& swing, double jerk, double most) {
    if (swing.gap <= 0.0 && (swing.speed > 0.0 || (swing.speed == 0.0 && swing.acceleration > 0.0))) return false;
    const double bound = largest_acceleration(swing, longest, jerk, most);
    const double step = std::min(longest, time_to_approach(swing.gap, swing.speed, bound));
    if (!(t + step > t) && swing.speed > 0.0) return false;
    // A disk that has just left, and is away by less than rounding, is not tested for this long.
    const double unseen = std::max(0x1p-40 * period, 0x1p-50 * t);
    t += swing.speed > 0.0 ? step : std::max(step, unseen);
    longest = std::max(unseen, std::min(2.0 * step, 0.125 * period));
    return true;
  }
};

// Time until a disk touches the side, >= 0; HUGE_VAL if that is after `span`. gap: from the disk's edge to the edge of
// the box; outward, g: its speed and acceleration towards that edge. A disk that overlaps by rounding touches now if it
// approaches; otherwise when it has come back.
inline double time_to_swinging_side(const SwingingSide& side, double gap, double outward, double g, double span) {
  const SideMotion& motion = side.motion;
  const double w = motion.angular_frequency();
  const double reach = std::abs(motion.amplitude);
  const double most = reach * (w * w) + g;
  const double jerk = reach * (w * w) * w;
  const double inmost = motion.inset + reach;
  for (SwingSearch search{motion.period}; search.t <= span;) {
    const double t = search.t;
    const double distance = gap - (outward * t + 0.5 * g * (t * t));
    const double towards = outward + g * t;
    // Where the side never comes: fall freely to its innermost place.
    if (const double clear = distance - inmost; clear > 0.0) {
      const double later = t + time_to_approach(clear, towards, g);
      if (later > t) {
        search.t = later;
        continue;
      }
    }
    const SidePlace place = motion.swung(side.now, t);
    const Swing swing{distance - place.inset, towards + place.speed, g + place.acceleration};
    if (!search.go_on(swing, jerk, most)) return t;
  }
  return HUGE_VAL;
}

}  // namespace carom
