// Where the steps of a run lie in time, and how a step is split when it is too long to be safe.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "core/base/check.hpp"
#include "core/base/types.hpp"
#include "core/disks/state.hpp"

namespace carom {

// Steps k = 0, 1, ... end at (k + 1) dt, the last one at t_end. Times are products, not sums: no drift, and scaling dt
// and t_end by a power of two scales every time exactly.
struct StepClock {
  double dt = 0.0;
  double t_end = 0.0;
  Count steps = 0;    // in the whole run
  double last = 0.0;  // length of the last step

  double start(Count k) const { return static_cast<double>(k) * dt; }
  double length(Count k) const { return k + 1 >= steps ? last : dt; }
  double end(Count k) const { return k + 1 >= steps ? t_end : static_cast<double>(k + 1) * dt; }
};

// A quotient t_end / dt within 1e-9 of a whole number counts as that number (10 / 0.01 is 1000 steps, not 1001).
// Preconditions: dt > 0, t_end >= 0.
inline StepClock make_step_clock(double dt, double t_end) {
  const double quotient = t_end / dt;
  const double nearest = std::round(quotient);
  const bool whole = std::abs(quotient - nearest) <= 1e-9 * quotient;
  const double steps = whole ? nearest : std::ceil(quotient);
  StepClock clock{dt, t_end, static_cast<Count>(steps)};
  // Where t_end is a whole number of steps but for rounding, the last step is a full one like the others.
  clock.last = whole ? dt : t_end - clock.start(clock.steps - 1);
  return clock;
}

// Counts a step. disk_time: the time that its disks spent in the box, summed over disks. The total is a Kahan sum, so
// that millions of steps round it no more than one does.
inline void count_step(Counters& c, double disk_time) {
  ++c.steps;
  const double more = disk_time - c.disk_time_excess;
  const double sum = c.disk_time + more;
  c.disk_time_excess = (sum - c.disk_time) - more;
  c.disk_time = sum;
}

// Counts a step of this length; disks that leave are taken to do so half-way. before, after: numbers of disks at its
// start, newly emitted ones included, and at its end.
inline void count_step(Counters& c, Count before, Count after, double length) {
  count_step(c, 0.5 * length * static_cast<double>(before + after));
}

// In one part of a step no disk may move further than this share of its own radius, so that two disks approach by at
// most half the sum of their radii: none can jump over another, only graze (F5 of docs/original.md). Smaller costs
// parts, larger misses glancing hits (their share grows with the square of the travel).
inline constexpr double safe_travel = 0.5;

// The dt with linear dt + square dt^2 = limit, for coefficients >= 0; infinite if both are 0.
inline double step_within(double limit, double linear, double square) {
  return 2.0 * limit / (linear + std::sqrt(linear * linear + 4.0 * square * limit));
}
inline constexpr double most_parts = 1000.0;

// Into how many equal parts a step of length dt must be split. travel2: largest (speed / radius)^2 of all disks, units
// 1 / time^2; fall: g dt / smallest radius, 1 / time, the speed that gravity adds. Throws PhysicsError beyond
// most_parts: such a dt is a mistake, and carrying on would seem to hang.
inline Count parts_of_step(double travel2, double fall, double dt) {
  const double travel = (std::sqrt(travel2) + fall) * dt;
  if (!(travel > safe_travel)) return 1;
  const double parts = std::ceil(travel / safe_travel);
  if (!(parts <= most_parts)) {
    throw PhysicsError(
        fmt::format("run.dt: the fastest disk moves {:.6g} radii in one step, more than {}; choose a smaller dt or the "
                    "exact method",
                    travel, safe_travel * most_parts));
  }
  return static_cast<Count>(parts);
}

}  // namespace carom
