// The exact method's geometry: the path of a disk between two events, and the times at which paths meet each other or a
// side. Every prediction is a pure function of the segments it is about: neither the time of the prediction, nor the
// search that found the pair, nor the division of the window among threads can change its bits.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/disks/domain.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/physics/moving_side.hpp"
#include "core/physics/swinging_side.hpp"

namespace carom {

inline constexpr double never = HUGE_VAL;

// Free flight from `start` on: straight, or a parabola under gravity. Times count from the start of the window.
struct PathSegment {
  double start = 0.0;         // time
  double x = 0.0, y = 0.0;    // centre at start; length; x and y wrapped along periodic sides
  double vx = 0.0, vy = 0.0;  // at start; length / time
};

inline double speed_at_start(const PathSegment& p) {
  return std::sqrt(p.vx * p.vx + p.vy * p.vy);
}

// The same path with its start moved to time s; no operation when it starts there.
inline PathSegment carried_to(PathSegment p, double s, const Gravity& g) {
  if (s == p.start) return p;
  drift<true>(p.x, p.y, p.vx, p.vy, s - p.start, g);
  p.start = s;
  return p;
}

// Displacement of the images above a sheared box at time s of the window; length. box: at the start of the window.
inline double offset_in_window(const Domain& box, double s) {
  return box.shear.offset + box.shear.jump * s;
}

// Relative position and velocity of two paths that begin at the same time, in a sheared box. Not inlined: such boxes
// are rare, and the loops around the call keep their registers.
[[gnu::noinline, gnu::cold]] inline Relative relative_in_shear(const PathSegment& a, const PathSegment& b,
                                                               const Domain& box) {
  const Relative raw{b.x - a.x, b.y - a.y, b.vx - a.vx, b.vy - a.vy};
  return to_row(raw, rows_to_nearest(raw.dy, box), offset_in_window(box, a.start), box);
}

// The same in any other box.
inline Relative relative(const PathSegment& a, const PathSegment& b, const Domain& box) {
  const Vec2 apart = nearest_image_at_rest({b.x - a.x, b.y - a.y}, box);
  return {apart.x, apart.y, b.vx - a.vx, b.vy - a.vy};
}

// Time from now until the disks touch, >= 0. Disks that approach and overlap (by rounding) collide now; disks that
// recede have no event, overlapping or not (Bannerman et al. 2014). So the root that suffers cancellation is never
// used.
inline double time_to_contact(const Relative& r, double contact_distance) {
  if (!(r.approach() < 0.0)) return never;
  const double t = touching_time(r, contact_distance);
  return t > 0.0 ? t : 0.0;
}

// Share of a period that a segment may cover before it is cut (a crossing event). Two segments then move by at most
// half a period relative to each other, so that of all images only the nearest at their common start and the one
// behind it can be met. Larger values would need more images.
inline constexpr double longest_flight = 0.25;

// A margin against rounding on how far disks travel. To test an image that cannot be reached changes no result.
inline constexpr double far_travel_margin = 1.0 + 1e-9;

// Time to contact with the images beyond the nearest one, if any of them can be reached within `span` (time).
inline double time_to_far_contact(const Relative& r, double contact_distance, const Domain& box, double span) {
  constexpr double margin = far_travel_margin;
  const bool far_x =
      box.periodic_x() && std::abs(r.dvx) * span * margin + contact_distance * margin >= box.width - std::abs(r.dx);
  const bool far_y =
      box.periodic_y() && std::abs(r.dvy) * span * margin + contact_distance * margin >= box.height - std::abs(r.dy);
  double t = never;
  Relative image = r;
  image.dx = r.dx > 0.0 ? r.dx - box.width : r.dx + box.width;
  if (far_x) t = std::min(t, time_to_contact(image, contact_distance));
  image.dy = r.dy > 0.0 ? r.dy - box.height : r.dy + box.height;
  if (far_x && far_y) t = std::min(t, time_to_contact(image, contact_distance));
  image.dx = r.dx;
  if (far_y) t = std::min(t, time_to_contact(image, contact_distance));
  return t;
}

// Time to contact with any image in a sheared box, where the rows of images above and below move. nearest: to the
// nearest image. offset: of the row above, now. Precondition: span is so short that no image passes another one.
[[gnu::noinline, gnu::cold]] inline double time_to_sheared_contact(const Relative& nearest, double contact_distance,
                                                                   const Domain& box, double offset, double span) {
  constexpr double margin = far_travel_margin;
  const auto in_row = [&](Relative image) {
    const double t = time_to_contact(image, contact_distance);
    if (std::abs(image.dvx) * span * margin + contact_distance * margin < box.width - std::abs(image.dx)) return t;
    image.dx = image.dx > 0.0 ? image.dx - box.width : image.dx + box.width;
    return std::min(t, time_to_contact(image, contact_distance));
  };
  const double t = in_row(nearest);
  if (std::abs(nearest.dvy) * span * margin + contact_distance * margin < box.height - std::abs(nearest.dy)) return t;
  return std::min(t, in_row(to_row(nearest, nearest.dy > 0.0 ? -1 : 1, offset, box)));
}

// The time at which two paths come into contact, `never` if that is after `end`. The first disk is the one with the
// smaller id. contact_distance = r1 + r2. Gravity cancels in relative motion, so that the quadratic is that of straight
// paths.
inline double collision_time(const PathSegment& first, const PathSegment& second, double contact_distance,
                             const Domain& box, const Gravity& g, double end) {
  const double both = std::max(first.start, second.start);
  if (box.shear.acts()) [[unlikely]] {
    const Relative r = relative_in_shear(carried_to(first, both, g), carried_to(second, both, g), box);
    const double s = both + time_to_sheared_contact(r, contact_distance, box, offset_in_window(box, both), end - both);
    return s <= end ? s : never;
  }
  const Relative r = relative(carried_to(first, both, g), carried_to(second, both, g), box);
  double t = time_to_contact(r, contact_distance);
  if (box.periodic_x() || box.periodic_y()) t = std::min(t, time_to_far_contact(r, contact_distance, box, end - both));
  const double s = both + t;
  return s <= end ? s : never;
}

// Time until a disk `gap` away from a wall or sink touches it, moving towards it at `speed`. A disk that overlaps by
// rounding counts as touching; a disk at rest on the floor touches now.
inline double time_to_side(Side side, double gap, double speed, const Gravity& g) {
  return time_to_approach(gap, speed, outward_acceleration(side, g));
}

// Time until a segment that moves towards this periodic side has covered longest_flight of the period; where gravity
// acts along that axis, a time by which it has surely not yet covered it.
inline double time_to_crossing(Side side, const PathSegment& p, const Domain& box, const Gravity& g) {
  const double speed = outward_speed(side, p.vx, p.vy);
  const double acceleration = outward_acceleration(side, g);
  const bool along_x = side == Side::left || side == Side::right;
  const double flight = longest_flight * (along_x ? box.width : box.height);
  if (along_x && acceleration == 0.0) return speed > 0.0 ? flight / speed : never;
  const double fast = std::abs(speed);
  const double root = std::sqrt(fast * fast + 2.0 * std::abs(acceleration) * flight);
  // One event for the axis: at the side that the disk moves towards; without speed, at the side that it falls to.
  const bool this_side = speed > 0.0 || (speed == 0.0 && acceleration > 0.0);
  return this_side ? 2.0 * flight / (fast + root) : never;
}

// How long after `start` to search for events up to `end`, including those that round to `end`: so that searches with
// different ends agree on the events before both. Time.
inline double span_until(double start, double end) {
  return (end - start) + 0x1p-52 * std::abs(end);
}

// A path and a moving side at the start of the path. Precondition of approach_of: box.places are those at the start of
// the window.
struct SideApproach {
  SidePlace place;  // of the side
  double gap;       // length, < 0: beyond it by rounding
  double speed;     // towards the side, in its frame
};

inline SideApproach approach_of(const PathSegment& p, Side side, double radius, const Domain& box) {
  const SidePlace place = box.place_after(side, p.start);
  return {place, -reach_beyond(side, p.x, p.y, radius, box) - place.inset, approach_speed(side, p.vx, p.vy, place)};
}

// Time until the path touches the side; of a sine, `never` if after `span`.
inline double time_to_moving_side(const PathSegment& p, Side side, double radius, const Domain& box, const Gravity& g,
                                  double span) {
  const SideMotion& motion = box.motions[static_cast<std::size_t>(side)];
  if (motion.kind == SideMotion::Kind::sine) {
    const SwingingSide swinging{motion, box.place_after(side, p.start)};
    const double gap = -reach_beyond(side, p.x, p.y, radius, box);
    return time_to_swinging_side(swinging, gap, outward_speed(side, p.vx, p.vy), outward_acceleration(side, g), span);
  }
  const SideApproach a = approach_of(p, side, radius, box);
  return time_to_approach(a.gap, a.speed, approach_acceleration(side, g, a.place));
}

// The time of a path's event at a side: contact with a wall or sink, or crossing a periodic side. A sink takes a disk
// that touches it, wherever the disk moves. `never` if after `end`.
inline double side_time(const PathSegment& p, Side side, double radius, const Domain& box, const Gravity& g,
                        double end) {
  if (box.moves(side)) {
    const double s = p.start + time_to_moving_side(p, side, radius, box, g, span_until(p.start, end));
    return s <= end ? s : never;
  }
  const SideKind kind = box.side(side);
  const double gap = -reach_beyond(side, p.x, p.y, radius, box);
  const double t = kind == SideKind::periodic           ? time_to_crossing(side, p, box, g)
                   : kind == SideKind::sink && gap <= 0 ? 0.0
                                                        : time_to_side(side, gap, outward_speed(side, p.vx, p.vy), g);
  const double s = p.start + t;
  return s <= end ? s : never;
}

[[gnu::always_inline]] inline void wrap_into(PathSegment& p, const Domain& box) {
  if (box.periodic_x()) p.x = wrap(p.x, box.width);
  if (box.periodic_y()) p.y = wrap(p.y, box.height);
}

// The same in any box. Returns the energy that a disk of this mass gains by crossing the bottom or the top of a sheared
// box.
inline double wrap_with_work(PathSegment& p, double mass, const Domain& box) {
  if (!box.shear.acts()) {
    wrap_into(p, box);
    return 0.0;
  }
  return box.shear.jump_rows(mass, p.vx, wrap_sheared(p.x, p.y, offset_in_window(box, p.start), box));
}

}  // namespace carom
