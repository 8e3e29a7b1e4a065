// Collisions that rounding would make ineffective. Disks that touch and pass along each other may approach by rounding
// alone, at 1e-16 of their speeds. The impulse that should reverse this is then below the last bit of their velocities:
// these do not change, and the disks collide again at the same moment, for ever. The same holds for a disk and an inner
// wall. So where both paths began at the moment of the contact, and the disks still approach after it, their velocities
// change by the least amount that parts them.
#pragma once

#include <algorithm>
#include <limits>

#include "core/physics/disk_pair.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// Do both paths begin at time s? Precondition: neither begins later.
inline bool both_begin_at(double s, const PathSegment& p, const PathSegment& q) {
  return !(s > p.start) && !(s > q.start);
}

// Calls push(k) with k = `least`, then twice that, and so on, until approach() is not negative or k overflows.
// Precondition: each push makes approach() larger, or leaves it as it is where k is too small.
template <class Approach, class Push>
void push_until_parted(double least, const Approach& approach, const Push& push) {
  constexpr double largest = std::numeric_limits<double>::max();
  for (double k = std::max(least, std::numeric_limits<double>::min()); approach() < 0.0 && k <= largest; k *= 2.0)
    push(k);
}

// Two disks (smaller id first) that have just collided; r: their relative motion before. share: of their masses. jump:
// in a sheared box, dvx of r less the difference of the disks' vx; length / time.
[[gnu::noinline, gnu::cold]] inline void part_disks(const Relative& r, Shares share, double jump, PathSegment& p,
                                                    PathSegment& q) {
  // The sum of their masses overflows: nothing moves them.
  if (!(share.first + share.second > 0.0)) return;
  const auto approach = [&] { return r.dx * ((q.vx - p.vx) + jump) + r.dy * (q.vy - p.vy); };
  push_until_parted(-r.approach() / r.distance2(), approach, [&](double k) {
    p.vx -= k * share.first * r.dx;
    p.vy -= k * share.first * r.dy;
    q.vx += k * share.second * r.dx;
    q.vy += k * share.second * r.dy;
  });
}

// A disk that has just bounced off a wall. line: the shortest one from the wall to its centre; length, not 0. wall: the
// wall's velocity.
[[gnu::noinline, gnu::cold]] inline void part_from_wall(Vec2 line, Vec2 wall, PathSegment& p) {
  const auto approach = [&] { return line.x * (p.vx - wall.x) + line.y * (p.vy - wall.y); };
  push_until_parted(-approach() / (line.x * line.x + line.y * line.y), approach, [&](double k) {
    p.vx += k * line.x;
    p.vy += k * line.y;
  });
}

}  // namespace carom
