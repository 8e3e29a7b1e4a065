// What sides that move come upon: obstacles and places of sources that stand still.
#pragma once

#include <cmath>

#include "core/disks/domain.hpp"

namespace carom {

// A side that moves, and when it comes upon something; time HUGE_VAL: never.
struct Sweep {
  Side side = Side::left;
  double time = HUGE_VAL;
  bool happens() const { return time < HUGE_VAL; }
};

// How far a side must come into the box to reach the rectangle from low to high; length.
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

// When a side moves into the rectangle until t_end, by more than `slack` (length).
inline Sweep sweep_of(const Domain& box, Side side, Vec2 low, Vec2 high, double slack, double t_end) {
  const double limit = inset_to_reach(box, side, low, high) + slack;
  return {side, box.motions[static_cast<std::size_t>(side)].first_time_beyond(limit, t_end)};
}

// The first of all sides.
inline Sweep first_sweep(const Domain& box, Vec2 low, Vec2 high, double slack, double t_end) {
  Sweep first;
  for (const Side side : all_sides) {
    const Sweep sweep = sweep_of(box, side, low, high, slack, t_end);
    if (sweep.time < first.time) first = sweep;
  }
  return first;
}

}  // namespace carom
