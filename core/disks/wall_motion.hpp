// How an inner wall moves, as time goes on: along a straight line, by itself, whatever meets it.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/types.hpp"
#include "core/disks/side_motion.hpp"

namespace carom {

// How far an inner wall is from where the scene has it, how fast it moves and how its velocity changes.
struct WallPlace {
  Vec2 shift;         // length
  Vec2 velocity;      // length / time
  Vec2 acceleration;  // length / time^2
};

// The time that a box is used for, as its inner walls need it. from < to: a step, at its end; time stepping sees no
// more than the mean velocity.
struct BoxTime {
  double from = 0.0, to = 0.0;
  bool operator==(const BoxTime&) const = default;
};

struct WallMotion {
  SideMotion pace{};  // of a wall whose velocity, or amplitude, is 1
  Vec2 along{};       // velocity, length / time; or amplitude of a vibration, which begins in this direction; length
  bool operator==(const WallMotion&) const = default;

  bool moves() const { return pace.moves(); }
  bool is_sine() const { return pace.kind == SideMotion::Kind::sine; }
  double largest_speed() const { return size() * pace.largest_speed(); }
  double largest_acceleration() const { return size() * pace.largest_acceleration(); }
  double size() const { return std::sqrt(along.x * along.x + along.y * along.y); }

  // Of a wall whose velocity, or amplitude, is 1: at the clock's time, and so much later (time; < 0 within a step
  // only).
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
