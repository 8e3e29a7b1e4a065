// The exact method: when a path touches an inner wall that vibrates as a sine. The search is that for a side
// (swinging_side.hpp). A segment is convex, so its distance from a disk grows at least by the disk's displacement along
// the present shortest line.
#pragma once

#include <cmath>

#include "core/physics/exact_path.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/swinging_side.hpp"

namespace carom {

struct SwingingWall {
  const Obstacle& wall;
  const WallMotion& motion;
  SidePlace now;  // its pace, at the start of the path
};

// Unit vector along a line; 0 if that has no length.
inline Vec2 direction_of(const ShortestLine& s) {
  if (s.flat) return s.line;
  return s.distance > 0.0 ? Vec2{s.line.x / s.distance, s.line.y / s.distance} : Vec2{};
}

// Time until a disk touches the wall, >= 0; HUGE_VAL if that is after `span`. apart: of the disk from the wall in the
// middle of its vibration. A disk that overlaps by rounding touches now if it approaches; otherwise when it has come
// back. A sink takes a disk that touches it, even if the disk recedes.
inline double time_to_swinging_wall(const SwingingWall& s, Vec2 apart, const PathSegment& p, double radius,
                                    const Gravity& g, double span) {
  const SideMotion& pace = s.motion.pace;
  const Vec2 along = s.motion.along;
  const double w = pace.angular_frequency();
  const double reach = s.motion.size();
  const bool sink = s.wall.kind == ObstacleKind::sink;
  for (SwingSearch search{pace.period}; search.t <= span;) {
    const double t = search.t;
    const Vec2 at{apart.x + (p.vx * t - 0.5 * g.left * (t * t)), apart.y + (p.vy * t - 0.5 * g.down * (t * t))};
    const Vec2 v{p.vx - g.left * t, p.vy - g.down * t};
    // Where the wall never comes: fall freely to a wall at rest that is thicker by the amplitude.
    const ShortestLine middle = shortest_line(s.wall, at);
    if (const double clear = middle.distance - radius - reach; clear > 0.0) {
      const Vec2 n = direction_of(middle);
      const double later = t + time_to_approach(clear, -(v.x * n.x + v.y * n.y), g.against(n.x, n.y));
      if (later > t) {
        search.t = later;
        continue;
      }
    }
    const SidePlace place = pace.swung(s.now, t);
    const ShortestLine line = shortest_line(s.wall, {at.x - along.x * place.inset, at.y - along.y * place.inset});
    const Vec2 n = direction_of(line);
    const double across = along.x * n.x + along.y * n.y;
    const double pressing = g.against(n.x, n.y);
    const Swing swing{line.distance - radius, across * place.speed - (v.x * n.x + v.y * n.y),
                      pressing + across * place.acceleration};
    if (sink && swing.gap <= 0.0) return t;
    const double jerk = std::abs(across) * (w * w) * w;
    const double most = std::abs(across) * (w * w) + pressing;
    if (!search.go_on(swing, jerk, most)) return t;
  }
  return HUGE_VAL;
}

}  // namespace carom
