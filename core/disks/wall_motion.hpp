// The prescribed motion of an inner wall, along a straight line.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/types.hpp"
#include "core/disks/side_motion.hpp"

namespace carom {

// Displacement of an inner wall from its place in the scene, its velocity and acceleration.
struct WallPlace {
  Vec2 shift;         // length
  Vec2 velocity;      // length / time
  Vec2 acceleration;  // length / time^2
};

// The time that a box is used for. from < to: the end of a step, where time stepping uses mean velocities over it; from
// == to: that moment.
struct BoxTime {
  double from = 0.0, to = 0.0;
  bool operator==(const BoxTime&) const = default;
};

struct WallMotion {
  SideMotion pace{};  // of a wall of unit velocity or amplitude
  Vec2 along{};  // velocity, length / time; or amplitude of a vibration, in the direction in which it begins, length
  bool operator==(const WallMotion&) const = default;

  bool moves() const { return pace.moves(); }
  bool is_sine() const { return pace.kind == SideMotion::Kind::sine; }
  double largest_speed() const { return size() * pace.largest_speed(); }
  double largest_acceleration() const { return size() * pace.largest_acceleration(); }
  double size() const { return std::sqrt(along.x * along.x + along.y * along.y); }

  // For a wall of unit velocity or amplitude: `later` (time; < 0 within a step only) after the clock's time.
  SidePlace pace_at(const BoxTime& clock, double later) const {
    const SidePlace now = pace.at(clock.to);
    if (clock.from < clock.to) {
      const double speed = (now.inset - pace.at(clock.from).inset) / (clock.to - clock.from);
      return SidePlace{now.inset, speed, 0.0}.after(later);
    }
    return is_sine() ? pace.swung(now, later) : now.after(later);
  }

  WallPlace at(const BoxTime& clock, double later = 0.0) const {
    const SidePlace p = pace_at(clock, later);
    return {{along.x * p.inset, along.y * p.inset},
            {along.x * p.speed, along.y * p.speed},
            {along.x * p.acceleration, along.y * p.acceleration}};
  }

  // The least and the largest shift between two times, along each axis.
  struct Range {
    Vec2 low, high;
  };
  Range range(double from, double to) const {
    const double before = pace.at(from).inset;
    double a = before;
    double b = pace.at(to).inset;
    if (pace.vibrates()) {
      const double way = pace.largest_speed() * (to - from);
      a = std::max(before - way, -1.0);
      b = std::min(before + way, 1.0);
    }
    return {{std::min(along.x * a, along.x * b), std::min(along.y * a, along.y * b)},
            {std::max(along.x * a, along.x * b), std::max(along.y * a, along.y * b)}};
  }
};

}  // namespace carom
