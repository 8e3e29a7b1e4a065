// The times at which moving sides reach rectangles at rest, such as obstacles or regions of sources.
#pragma once

#include <cmath>

#include "core/disks/domain.hpp"

namespace carom {

// A moving side, and the time at which it reaches something; HUGE_VAL: never.
struct Sweep {
  Side side = Side::left;
  double time = HUGE_VAL;
  bool happens() const { return time < HUGE_VAL; }
};

// The inset of a side at which it reaches the rectangle [low, high]; length.
inline double inset_to_reach(const Domain& box, Side side, Vec2 low, Vec2 high) {
  switch (side) {
    case Side::left:
      return low.x;
    case Side::right:
      return box.width - high.x;
    case Side::bottom:
      return low.y;
    default:
      return box.height - high.y;
  }
}

// The time until t_end at which a side has moved into the rectangle by more than `slack` (length).
inline Sweep sweep_of(const Domain& box, Side side, Vec2 low, Vec2 high, double slack, double t_end) {
  const double limit = inset_to_reach(box, side, low, high) + slack;
  return {side, box.motions[static_cast<std::size_t>(side)].first_time_beyond(limit, t_end)};
}

// The earliest of all sides.
inline Sweep first_sweep(const Domain& box, Vec2 low, Vec2 high, double slack, double t_end) {
  Sweep first;
  for (const Side side : all_sides) {
    const Sweep sweep = sweep_of(box, side, low, high, slack, t_end);
    if (sweep.time < first.time) first = sweep;
  }
  return first;
}

}  // namespace carom
