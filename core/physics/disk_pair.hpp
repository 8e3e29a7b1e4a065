// Two disks: do they touch, do they approach, when did or will they touch, what does the collision do.
// Each formula stands here once; every method and both engines call it. Only the exact method's prediction kernel and
// plain collision (parallel/exact) write (12) and (23) once more, for vectors; tests hold their bits against these.
// The first disk is the one with the smaller id, so that the operands, and with them the bits, do not depend on which
// search found the pair. Formulas (6), (12), (16), (23) and faults F4, F8, F9: docs/original.md.
#pragma once

#include <cmath>

#include "core/disks/domain.hpp"

namespace carom {

// Position and velocity of the second disk relative to the first, nearest image.
struct Relative {
  double dx, dy;    // length
  double dvx, dvy;  // length / time

  double distance2() const { return dx * dx + dy * dy; }
  // Half the rate of change of the squared distance; < 0: the disks approach (F8 is mended by asking for it).
  double approach() const { return dx * dvx + dy * dvy; }
  double speed2() const { return dvx * dvx + dvy * dvy; }
};

// Of the images of the second disk in a sheared box, that in the row `rows` (image_in_row); each row above moves faster
// by the shear's jump. raw: the relative position and velocity in the box itself. offset: displacement of the row
// above; length.
inline Relative to_row(const Relative& raw, int rows, double offset, const Domain& box) {
  const Vec2 apart = image_in_row({raw.dx, raw.dy}, rows, offset, box);
  return {apart.x, apart.y, raw.dvx + rows * box.shear.jump, raw.dvy};
}

// (6), with contact included: "overlaps or touches". contact_distance = r1 + r2.
inline bool touches(double distance2, double contact_distance) {
  return distance2 <= contact_distance * contact_distance;
}

// Time from now at which two disks on straight relative paths touch: the smaller root of (12) in the form that does
// not cancel, t = c / (-b + sqrt(b^2 - a c)) with a = dv.dv, b = dr.dv, c = dr.dr - contact_distance^2. Negative when
// they overlap now: the contact lies that far back. The discriminant is taken as a contact_distance^2 - (dr x dv)^2,
// which is the same number with less cancellation for distant disks. Same with gravity, which relative motion does not
// feel. Preconditions: approach() < 0 (so a > 0: F9 cannot happen). Returns infinity when the paths miss.
inline double touching_time(const Relative& r, double contact_distance) {
  const double cross = r.dx * r.dvy - r.dy * r.dvx;
  const double discriminant = r.speed2() * (contact_distance * contact_distance) - cross * cross;
  if (discriminant < 0.0) return HUGE_VAL;
  return (r.distance2() - contact_distance * contact_distance) / (std::sqrt(discriminant) - r.approach());
}

// Shares of a change of relative velocity (or position): first = m2 / (m1 + m2), second = m1 / (m1 + m2).
struct Shares {
  double first, second;
};
inline constexpr Shares equal_shares{0.5, 0.5};

inline Shares shares(double m1, double m2) {
  const double sum = m1 + m2;
  return {m2 / sum, m1 / sum};
}

inline double reduced_mass(double m1, double m2) {
  return m1 / (m1 + m2) * m2;
}

// The collision rule (23) for any masses and restitution, along the line of centres only: the normal relative velocity
// is multiplied by -e, the tangential one and the total momentum stay. With e = 1 it is the right elastic rule for
// unequal masses, which the swap (16) is not (F4). No square root: n n = dr dr / dr^2. Precondition: distance2() > 0.
// Returns by how much dr.dv has grown, (1 + e) |dr.dv|; times the reduced mass it is |impulse| x distance, the virial
// of the collision. Always inlined: a call, with its arguments in memory, costs the exact engine 50 instructions more
// in each collision.
[[gnu::always_inline]] inline double collide(const Relative& r, Shares share, double restitution, double& vx1,
                                             double& vy1, double& vx2, double& vy2) {
  const double change = (1.0 + restitution) * r.approach();
  const double k = change / r.distance2();
  const double k1 = k * share.first;
  const double k2 = k * share.second;
  vx1 += k1 * r.dx;
  vy1 += k1 * r.dy;
  vx2 -= k2 * r.dx;
  vy2 -= k2 * r.dy;
  return -change;
}

}  // namespace carom
