// The collision of two smooth disks whose paths cross no border along a period: the operations of core's collide_paths
// in the same order, with x and y of a vector at once. The exact method spends most of its work on disks in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/disks/domain.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/exact_path.hpp"
#include "core/physics/parting.hpp"

namespace carom {

// x and y of a vector.
using Coordinates = double __attribute__((vector_size(16)));

static_assert(offsetof(PathSegment, y) == offsetof(PathSegment, x) + sizeof(double));
static_assert(offsetof(PathSegment, vy) == offsetof(PathSegment, vx) + sizeof(double));

// Loads two successive numbers: an x, and the y behind it.
[[gnu::always_inline]] inline Coordinates load_xy(const double* x) {
  Coordinates v;
  __builtin_memcpy(&v, x, sizeof v);
  return v;
}

[[gnu::always_inline]] inline void store_xy(double* x, Coordinates v) {
  __builtin_memcpy(x, &v, sizeof v);
}

// The motion of all disks between collisions: straight, or under gravity. Each type carries a path to time s as core's
// drift does.
struct FreeFlight {
  static constexpr bool falls = false;
  [[gnu::always_inline]] Coordinates place_at(double s, const PathSegment& p) const {
    return load_xy(&p.x) + load_xy(&p.vx) * Coordinates{s - p.start, s - p.start};
  }
  [[gnu::always_inline]] Coordinates velocity_at(double /*s*/, const PathSegment& p) const { return load_xy(&p.vx); }
};

struct FreeFall {
  static constexpr bool falls = true;
  Coordinates gravity, half_gravity;  // left and down; length / time^2
  Coordinates zero;  // added to the change of velocity if drift adds one; otherwise -0, which adds nothing

  explicit FreeFall(const Gravity& g)
      : gravity{g.is_tilted() ? g.left : 0.0, g.down},
        half_gravity{0.5 * gravity},
        zero{g.is_tilted() ? -0.0 : 0.0, 0.0} {}

  [[gnu::always_inline]] Coordinates place_at(double s, const PathSegment& p) const {
    const double t = s - p.start;
    return load_xy(&p.x) + (load_xy(&p.vx) * Coordinates{t, t} - half_gravity * Coordinates{t * t, t * t});
  }
  [[gnu::always_inline]] Coordinates velocity_at(double s, const PathSegment& p) const {
    const double t = s - p.start;
    return load_xy(&p.vx) - (gravity * Coordinates{t, t} + zero);
  }
};

[[gnu::always_inline]] inline double sum_of(Coordinates v) {
  return v[0] + v[1];
}

// The part of the box where disks meet no image and cross no border along a period.
struct InnerPart {
  Coordinates low, high;  // from low to just below high; infinite along sides without a period
  Coordinates far;        // two disks must be nearer than this to each other, along x and along y

  explicit InnerPart(const Domain& box)
      : low{box.periodic_x() ? 0.0 : -HUGE_VAL, box.periodic_y() ? 0.0 : -HUGE_VAL},
        high{box.periodic_x() ? box.width : HUGE_VAL, box.periodic_y() ? box.height : HUGE_VAL},
        far{0.5 * high} {}

  // Are disks with these paths in that part at time s?
  template <class Flight>
  [[gnu::always_inline]] bool holds(double s, const Flight& flight, const PathSegment& p, const PathSegment& q) const {
    const Coordinates at_p = flight.place_at(s, p);
    const Coordinates at_q = flight.place_at(s, q);
    const Coordinates dr = at_q - at_p;
    const auto inside = (at_p >= low) & (at_p < high) & (at_q >= low) & (at_q < high) & (dr < far) & (-dr < far);
    return (inside[0] & inside[1]) != 0;
  }
};

// The same restitution for all pairs.
struct ConstantRestitution {
  double value;
  double operator()(const Relative& /*met*/) const { return value; }
};

struct PlainCollision {
  bool happened = false;     // if false, the disks recede by rounding, and only begin new paths
  double change = 0.0;       // of the squared-distance rate, as collide() returns it
  double shear_share = 0.0;  // share of the virial that is PairImpact::shear_virial in a sheared box, for smooth disks
  double fastest2 = 0.0;     // largest v^2 of the two disks
};

// Disks with these paths (smaller id first) collide at time s; their new paths start there. share: of their masses.
// restitution(r): for the relative motion r.
template <class Flight, class RestitutionOf>
[[gnu::always_inline]] inline PlainCollision collide_plainly(double s, const Flight& flight, Shares share,
                                                             const RestitutionOf& restitution, PathSegment& p,
                                                             PathSegment& q) {
  const Coordinates at_p = flight.place_at(s, p);
  const Coordinates at_q = flight.place_at(s, q);
  Coordinates vp = flight.velocity_at(s, p);
  Coordinates vq = flight.velocity_at(s, q);
  const Coordinates dr = at_q - at_p;
  const Coordinates dv = vq - vp;
  const double approach = sum_of(dr * dv);
  const double distance2 = sum_of(dr * dr);
  PlainCollision outcome;
  if (approach < 0.0 && distance2 > 0.0) [[likely]] {
    const double change = (1.0 + restitution(Relative{dr[0], dr[1], dv[0], dv[1]})) * approach;
    const double k = change / distance2;
    const double k1 = k * share.first;
    const double k2 = k * share.second;
    vp = vp + Coordinates{k1, k1} * dr;
    vq = vq - Coordinates{k2, k2} * dr;
    outcome.happened = true;
    outcome.change = -change;
    outcome.shear_share = dr[0] * dr[1] / distance2;
  }
  outcome.fastest2 = std::max(sum_of(vp * vp), sum_of(vq * vq));
  const bool begin_now = both_begin_at(s, p, q);
  p.start = q.start = s;
  store_xy(&p.x, at_p);
  store_xy(&q.x, at_q);
  store_xy(&p.vx, vp);
  store_xy(&q.vx, vq);
  if (begin_now && outcome.happened) [[unlikely]] {
    part_disks(Relative{dr[0], dr[1], dv[0], dv[1]}, share, 0.0, p, q);
    outcome.fastest2 = std::max(p.vx * p.vx + p.vy * p.vy, q.vx * q.vx + q.vy * q.vy);
  }
  return outcome;
}

}  // namespace carom
