// The exact method's contact of a path with a side that vibrates as a sine. It is the root of no polynomial: it is come
// up to from the past, by steps that no contact can lie in, as the gap is above a parabola whose curvature is a bound
// of the true one. So the first contact is never missed, however close to it others are.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/physics/moving_side.hpp"

namespace carom {

struct SwingingSide {
  const SideMotion& motion;
  SidePlace now;  // at the start of the path
};

// A path and the side, at some time.
struct Swing {
  double gap;           // length, < 0: beyond the side
  double speed;         // towards it, in its frame
  double acceleration;  // likewise
};

// The largest acceleration towards the side within time h of a Swing: a sine's changes by amplitude w^3 per time at
// most, and `most` is what it can be at all.
inline double largest_acceleration(const Swing& swing, double h, double jerk, double most) {
  return std::min(most, swing.acceleration + jerk * h);
}

// A search for the first contact with what vibrates: how far it has come, and how far its next step may go.
struct SwingSearch {
  double period;
  double t = 0.0;
  double longest = 0.125 * period;

  // Goes on from t, where `swing` holds, as far as surely nothing touches; false: it touches at t. `most`: what the
  // acceleration can be at all, `jerk`: what it changes by per time.
  bool go_on(const Swing& swing, double jerk, double most) {
    if (swing.gap <= 0.0 && (swing.speed > 0.0 || (swing.speed == 0.0 && swing.acceleration > 0.0))) return false;
    const double bound = largest_acceleration(swing, longest, jerk, most);
    const double step = std::min(longest, time_to_approach(swing.gap, swing.speed, bound));
    if (!(t + step > t) && swing.speed > 0.0) return false;
    // A disk that has just left, by less than rounding, is not seen for so long.
    const double unseen = std::max(0x1p-40 * period, 0x1p-50 * t);
    t += swing.speed > 0.0 ? step : std::max(step, unseen);
    longest = std::max(unseen, std::min(2.0 * step, 0.125 * period));
    return true;
  }
};

// Time until a disk touches the side, >= 0; `HUGE_VAL` if that is after `span`. gap: of its edge to the edge of the
// box; outward and g: its speed and acceleration towards that. A disk that overlaps by rounding touches if it
// approaches; if not, when it has come back.
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
    // Where the side never comes, a floor at its furthest is as far.
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
