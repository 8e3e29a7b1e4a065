// A disk and one side of the box: how far beyond, since when, and what a wall does.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"

namespace carom {

// How far the disk's edge reaches beyond the side; length, >= 0: it touches (x - r <= 0 and so on for the four sides).
inline double reach_beyond(Side side, double x, double y, double r, const Domain& box) {
  switch (side) {
    case Side::left:
      return r - x;
    case Side::right:
      return (x + r) - box.width;
    case Side::bottom:
      return r - y;
    default:
      return (y + r) - box.height;
  }
}

// The same of a wall that may move: beyond where it is.
inline double reach_beyond_wall(Side side, double x, double y, double r, const Domain& box) {
  return reach_beyond(side, x, y, r, box) + box.place(side).inset;
}

// Speed towards the side; > 0: the disk moves into it.
inline double outward_speed(Side side, double vx, double vy) {
  switch (side) {
    case Side::left:
      return -vx;
    case Side::right:
      return vx;
    case Side::bottom:
      return -vy;
    default:
      return vy;
  }
}

// Acceleration towards the side; length / time^2. > 0: gravity presses disks against it, as against a floor.
inline double outward_acceleration(Side side, const Gravity& g) {
  switch (side) {
    case Side::left:
      return g.left;
    case Side::right:
      return -g.left;
    case Side::bottom:
      return g.down;
    default:
      return -g.down;
  }
}

// Time since the disk touched the wall it now reaches beyond, on its present path; where gravity accelerates it across
// the wall, the smaller root of a quadratic, beyond = speed t - a t^2 / 2, in the form that does not cancel.
// Infinity when this path never was inside (a disk pressed into the floor by others).
// Preconditions: beyond >= 0, speed > 0.
inline double time_since_wall(Side side, double beyond, double speed, const Gravity& g) {
  const double acceleration = outward_acceleration(side, g);
  if (acceleration == 0.0) return beyond / speed;
  const double discriminant = speed * speed - 2.0 * acceleration * beyond;
  if (discriminant < 0.0) return HUGE_VAL;
  return 2.0 * beyond / (speed + std::sqrt(discriminant));
}

// What rounding may add to, or take from, the time since a contact, as a share of the step. Disks are often left just
// touching at the end of a step: pushed apart, or put back to a wall. The contact of those that then come on begins
// with the next step, and rounding must not say whether before it or after.
inline constexpr double start_of_step = 1e-6;

// Did a contact, `ago` before the end of a step of length dt, begin within it?
inline bool began_within(double ago, double dt) {
  return ago <= dt * (1.0 + start_of_step);
}

// The time since a contact as contacts are ordered by it: those that began with the step or before it all have dt.
inline double time_within(double ago, double dt) {
  return ago < dt * (1.0 - start_of_step) ? ago : dt;
}

// Was a disk that reaches `beyond` past a wall, or an obstacle, beyond it before the step began, so that it is met
// late? Not where gravity presses it there (ago is infinite), nor by rounding of a disk that just touched.
inline bool is_met_late(double ago, double beyond, double speed, double dt) {
  constexpr double more_than_rounding = 1.01;
  return ago > dt && beyond > more_than_rounding * speed * dt;
}

// Speed towards the side that the disk had, or by its energy would have, at the wall itself: what lifting it back from
// `beyond` costs under gravity is taken from its motion. 0 where its energy does not reach that far.
inline double speed_at_wall(Side side, double beyond, double speed, const Gravity& g) {
  const double acceleration = outward_acceleration(side, g);
  if (acceleration == 0.0) return speed;
  return std::sqrt(std::max(0.0, speed * speed - 2.0 * acceleration * beyond));
}

// Unit vector away from the side, into the box.
inline Vec2 inward_normal(Side side) {
  switch (side) {
    case Side::left:
      return {1.0, 0.0};
    case Side::right:
      return {-1.0, 0.0};
    case Side::bottom:
      return {0.0, 1.0};
    default:
      return {0.0, -1.0};
  }
}

// The wall's collision rule: the velocity into it is multiplied by -restitution, the other component stays.
inline void bounce(Side side, double restitution, double& vx, double& vy) {
  if (side == Side::left || side == Side::right) {
    vx = -restitution * vx;
  } else {
    vy = -restitution * vy;
  }
}

// Coordinate of a centre that just touches the side: the exact place after a correction, free of rounding drift.
inline double touching_coordinate(Side side, double r, const Domain& box) {
  const double inset = box.place(side).inset;
  switch (side) {
    case Side::left:
    case Side::bottom:
      return r + inset;
    case Side::right:
      return (box.width - r) - inset;
    default:
      return (box.height - r) - inset;
  }
}

}  // namespace carom
