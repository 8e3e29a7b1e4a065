// A disk and one side of the box: how far the disk reaches beyond it, since when, and how a wall reflects it.
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

// How far the disk's edge reaches beyond a wall that may move; length.
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

// Time since the disk, on its present path, touched the wall that it now reaches beyond. Where gravity acts across the
// wall this is the smaller root of beyond = speed t - a t^2 / 2, in the form that does not cancel. Infinity if the path
// never was inside (a disk pressed into the floor by others). Preconditions: beyond >= 0, speed > 0.
inline double time_since_wall(Side side, double beyond, double speed, const Gravity& g) {
  const double acceleration = outward_acceleration(side, g);
  if (acceleration == 0.0) return beyond / speed;
  const double discriminant = speed * speed - 2.0 * acceleration * beyond;
  if (discriminant < 0.0) return HUGE_VAL;
  return 2.0 * beyond / (speed + std::sqrt(discriminant));
}

// Tolerance of the time since a contact, as a share of the step. Steps often leave disks just touching: pushed apart,
// or put back to a wall. If such disks approach, their contact begins exactly with the next step, and rounding must not
// decide whether it began before the step or in it.
inline constexpr double start_of_step = 1e-6;

// Did a contact that began `ago` before the end of a step of length dt begin within the step?
inline bool began_within(double ago, double dt) {
  return ago <= dt * (1.0 + start_of_step);
}

// The time since a contact by which contacts are ordered: dt for all that began with the step or before it.
inline double time_within(double ago, double dt) {
  return ago < dt * (1.0 - start_of_step) ? ago : dt;
}

// Did a disk that reaches `beyond` past a wall or an obstacle do so before the step began, so that its collision comes
// late? False for a disk that gravity presses there (ago is infinite), and where only rounding says so of a disk that
// just touched.
inline bool is_met_late(double ago, double beyond, double speed, double dt) {
  constexpr double more_than_rounding = 1.01;
  return ago > dt && beyond > more_than_rounding * speed * dt;
}

// The speed towards the side that the disk has at the wall itself, by conservation of energy: lifting it back from
// `beyond` against gravity costs kinetic energy. 0 where its energy does not suffice.
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

// Coordinate of the centre of a disk that just touches the side. To place disks by it, instead of moving them by a
// difference, lets no rounding accumulate.
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
