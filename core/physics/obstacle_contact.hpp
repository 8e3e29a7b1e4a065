// A disk and an obstacle in time stepping: how deep one lies in the other, and since when. An obstacle is a wall that
// may be curved: the formulas are those of boundary.hpp along the shortest line to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/disks/wall_motion.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom {

// The shortest line from an obstacle's centre, or from a segment, to a point.
struct ShortestLine {
  Vec2 line;        // its direction: the line itself, or, from within a segment, a unit vector across
  double length2;   // of `line`, squared
  double distance;  // length of the line
  bool flat;        // from within a segment
  Vec2 shift{};     // of the image of the obstacle that it starts from
};

// apart: the point relative to (o.x, o.y).
inline ShortestLine shortest_line(const Obstacle& o, Vec2 apart) {
  if (o.is_segment()) {
    const double length = std::sqrt(o.dx * o.dx + o.dy * o.dy);
    const double ux = o.dx / length;
    const double uy = o.dy / length;
    const double along = apart.x * ux + apart.y * uy;
    if (along >= 0.0 && along <= length) {
      const double across = apart.y * ux - apart.x * uy;
      return {across >= 0.0 ? Vec2{-uy, ux} : Vec2{uy, -ux}, 1.0, std::abs(across), true};
    }
    if (along > 0.0) apart = {apart.x - o.dx, apart.y - o.dy};
  }
  const double length2 = apart.x * apart.x + apart.y * apart.y;
  return {apart, length2, std::sqrt(length2), false};
}

// A moving obstacle at one moment, as an obstacle at rest there, with its velocity and acceleration in `place`.
struct PlacedObstacle {
  Obstacle obstacle;
  WallPlace place;
};

[[gnu::noinline, gnu::cold]] inline PlacedObstacle placed(const Obstacle& o, const Domain& box, double later = 0.0) {
  PlacedObstacle now{o, box.obstacles->motion_of(o).at(box.clock, later)};
  now.obstacle.x += now.place.shift.x;
  now.obstacle.y += now.place.shift.y;
  now.obstacle.moves = false;
  return now;
}

// The whole periods, as lengths, by which `apart` is further than the nearest image.
inline Vec2 whole_periods(Vec2 apart, const Domain& box) {
  return {box.periodic_x() ? std::floor(apart.x / box.width + 0.5) * box.width : 0.0,
          box.periodic_y() ? std::floor(apart.y / box.height + 0.5) * box.height : 0.0};
}

// The shortest line from the nearest image of an obstacle at rest. Precondition: (x, y) lies outside the box by less
// than half a period.
inline ShortestLine shortest_line(const Obstacle& o, double x, double y, const Domain& box) {
  const Vec2 apart{x - o.x, y - o.y};
  if (!o.is_segment()) {
    const Vec2 nearest = nearest_image(apart, box);
    ShortestLine line = shortest_line(o, nearest);
    line.shift = {apart.x - nearest.x, apart.y - nearest.y};
    return line;
  }
  ShortestLine nearest = shortest_line(o, apart);
  const int images_x = box.periodic_x() ? 1 : 0;
  const int images_y = box.periodic_y() ? 1 : 0;
  for (int ky = -images_y; ky <= images_y; ++ky) {
    for (int kx = -images_x; kx <= images_x; ++kx) {
      const Vec2 shift{kx * box.width, ky * box.height};
      const ShortestLine image = shortest_line(o, {apart.x - shift.x, apart.y - shift.y});
      if (!(image.distance < nearest.distance)) continue;
      nearest = image;
      nearest.shift = shift;
    }
  }
  return nearest;
}

// The same for an obstacle whose motion may have carried it through a periodic box many times.
inline ShortestLine shortest_line_wound(Obstacle o, double x, double y, const Domain& box) {
  const Vec2 wound = whole_periods({x - o.x, y - o.y}, box);
  o.x += wound.x;
  o.y += wound.y;
  ShortestLine line = shortest_line(o, x, y, box);
  line.shift = {line.shift.x + wound.x, line.shift.y + wound.y};
  return line;
}

struct ObstacleGap {
  double nx, ny;    // unit vector from the obstacle to the disk
  double beyond;    // how far the disk's edge reaches beyond the obstacle's; length, >= 0: they touch
  bool flat;        // at the inside of a segment
  Vec2 shift{};     // of the obstacle's image
  Vec2 velocity{};  // of the obstacle; length / time
};

inline ObstacleGap gap_along(const ShortestLine& s, double contact) {
  if (s.flat) return {s.line.x, s.line.y, contact - s.distance, true, s.shift};
  const double nx = s.distance > 0.0 ? s.line.x / s.distance : 0.0;
  const double ny = s.distance > 0.0 ? s.line.y / s.distance : 1.0;
  return {nx, ny, contact - s.distance, false, s.shift};
}

inline ObstacleGap gap_to_placed(const PlacedObstacle& now, double x, double y, double r, const Domain& box) {
  ObstacleGap gap = gap_along(shortest_line_wound(now.obstacle, x, y, box), r);
  gap.velocity = now.place.velocity;
  return gap;
}

[[gnu::noinline, gnu::cold]] inline ObstacleGap gap_to_moving(const Obstacle& o, double x, double y, double r,
                                                              const Domain& box) {
  return gap_to_placed(placed(o, box), x, y, r, box);
}

// The same if the image displaced by `shift` is in reach, up to rounding; otherwise only `beyond` < 0 is meaningful.
[[gnu::noinline, gnu::cold]] inline ObstacleGap gap_to_moving_image(const Obstacle& o, double x, double y, double r,
                                                                    Vec2 shift, const Domain& box) {
  const PlacedObstacle now = placed(o, box);
  const Vec2 apart{(x - now.obstacle.x) - shift.x, (y - now.obstacle.y) - shift.y};
  const double beyond = r - shortest_line(now.obstacle, apart).distance;
  if (beyond < -1e-6 * r) return {0.0, 1.0, beyond, false};
  return gap_to_placed(now, x, y, r, box);
}

// To the nearest image. If the centres coincide, the normal points upwards.
inline ObstacleGap gap_to(const Obstacle& o, double x, double y, double r, const Domain& box) {
  if (o.moves) [[unlikely]]
    return gap_to_moving(o, x, y, r, box);
  return gap_along(shortest_line(o, x, y, box), r + o.radius);
}

// Is a disk of radius r, `apart` from the obstacle's (x, y), certainly out of contact with it?
inline bool is_surely_beyond(const Obstacle& o, Vec2 apart, double r) {
  if (o.is_segment()) return shortest_line(o, apart).distance > r;
  const double contact = (r + o.radius) * (1.0 + 1e-6);
  return apart.x * apart.x + apart.y * apart.y > contact * contact;
}

// Calls found(k, gap) if a disk of radius r at (x, y) overlaps or touches the image of obstacle k that is displaced by
// `shift`, and this is the nearest one.
template <class Found>
void report_if_touched(const Domain& box, std::uint32_t k, Vec2 shift, double x, double y, double r, Found&& found) {
  const Obstacle& o = (*box.obstacles)[k];
  // First a cheap test of this image alone: most are out of reach.
  if (!o.moves && is_surely_beyond(o, {(x - o.x) - shift.x, (y - o.y) - shift.y}, r)) return;
  const ObstacleGap gap = o.moves ? gap_to_moving_image(o, x, y, r, shift, box) : gap_to(o, x, y, r, box);
  // Several images may be visited, whole periods apart; only the nearest counts.
  const bool nearest =
      std::abs(shift.x - gap.shift.x) < 0.5 * box.width && std::abs(shift.y - gap.shift.y) < 0.5 * box.height;
  if (gap.beyond >= 0.0 && nearest) found(k, gap);
}

// Calls found(k, gap) once for each obstacle k that a disk of radius r at (x, y) overlaps or touches, sinks included.
// Precondition: box.obstacles is not null.
template <class Found>
void for_each_obstacle_touched(const Domain& box, double x, double y, double r, Found&& found) {
  box.obstacles->visit({x - r, y - r}, {x + r, y + r},
                       [&](std::uint32_t k, Vec2 shift) { report_if_touched(box, k, shift, x, y, r, found); });
}

// The same without sinks: what disks bounce off.
template <class Found>
void for_each_solid_touched(const Domain& box, double x, double y, double r, Found&& found) {
  for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t k, const ObstacleGap& gap) {
    if ((*box.obstacles)[k].kind != ObstacleKind::sink) found(k, gap);
  });
}

// The same in the order of the list, whatever cells the obstacles lie in: found() may move the disk, so the order
// matters.
template <class Found>
void for_each_solid_touched_in_order(const Domain& box, double x, double y, double r, Found&& found) {
  std::uint32_t from = 0;
  for (bool any = true; any;) {
    any = false;
    std::uint32_t first = 0;
    ObstacleGap gap{};
    for_each_solid_touched(box, x, y, r, [&](std::uint32_t k, const ObstacleGap& seen) {
      if (k < from || (any && k >= first)) return;
      any = true;
      first = k;
      gap = seen;
    });
    if (!any) return;
    found(first, gap);
    from = first + 1;
  }
}

// Where inner walls join, a disk touches both segments at the same point, and one of the two contacts must be dropped:
// two contacts would look like those of a squeezed disk (resting.hpp), which does not bounce. The contact `hidden` is
// dropped in favour of `other` if the disk of radius r touches the same point in both, and `hidden` is at a segment's
// end and `other` at a side; of two ends or two sides, the one later in the list is dropped.
inline bool hides(const ObstacleGap& other, bool is_later, const ObstacleGap& hidden, double r, const Domain& box) {
  if (other.velocity.x != hidden.velocity.x || other.velocity.y != hidden.velocity.y) return false;
  const double rounding = 1e-12 * r + 0x1p-46 * std::max(box.width, box.height);
  const double distance = r - other.beyond;
  // From the disk's centre to the point that is touched.
  const Vec2 point{-(r - hidden.beyond) * hidden.nx, -(r - hidden.beyond) * hidden.ny};
  const Vec2 apart{point.x + distance * other.nx, point.y + distance * other.ny};
  if (other.flat && !hidden.flat) return std::abs(apart.x * other.nx + apart.y * other.ny) <= rounding;
  const bool same_point = std::abs(apart.x) <= rounding && std::abs(apart.y) <= rounding;
  return same_point && other.flat == hidden.flat && is_later;
}

// Is the contact of a disk of radius r at (x, y) with obstacle k dropped in favour of another segment's?
inline bool is_hidden(const Domain& box, std::uint32_t k, const ObstacleGap& gap, double x, double y, double r) {
  if (!(*box.obstacles)[k].is_segment()) return false;
  bool hidden = false;
  for_each_solid_touched(box, x, y, r, [&](std::uint32_t j, const ObstacleGap& other) {
    if (j == k || !(*box.obstacles)[j].is_segment()) return;
    hidden = hidden || hides(other, k > j, gap, r, box);
  });
  return hidden;
}

// Does a disk overlap or touch any obstacle?
inline bool touches_obstacle(const Domain& box, double x, double y, double r) {
  bool touched = false;
  if (box.obstacles != nullptr) {
    for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t, const ObstacleGap&) { touched = true; });
  }
  return touched;
}

// The number of the inner sink that the disk touches, the smallest of several; no_sink if none.
inline SinkNumber inner_sink_touched(const Domain& box, double x, double y, double r) {
  SinkNumber sink = no_sink;
  if (box.obstacles == nullptr || !box.obstacles->has_sinks()) return sink;
  for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t k, const ObstacleGap&) {
    const Obstacle& o = (*box.obstacles)[k];
    if (o.kind == ObstacleKind::sink) sink = std::min(sink, sink_number(o));
  });
  return sink;
}

inline bool touches_inner_sink(const Domain& box, double x, double y, double r) {
  return inner_sink_touched(box, x, y, r) != no_sink;
}

// Speed towards the obstacle, in its frame; > 0: the disk moves into it.
inline double speed_towards(const ObstacleGap& gap, double vx, double vy) {
  return -((vx - gap.velocity.x) * gap.nx + (vy - gap.velocity.y) * gap.ny);
}

// Time since the disk touched the side of a segment: as time_since_wall, for a tilted wall.
inline double time_since_flat(const ObstacleGap& gap, double speed, const Gravity& g) {
  const double discriminant = speed * speed - 2.0 * g.against(gap.nx, gap.ny) * gap.beyond;
  return discriminant < 0.0 ? HUGE_VAL : 2.0 * gap.beyond / (speed + std::sqrt(discriminant));
}

// Time since the disk touched the obstacle, on its present path; infinity if the path never did. Without gravity this
// is the root of a quadratic (touching_time). With gravity, two Newton steps from there leave an error of the order of
// g^2 dt^4; it shifts the place of the impact but not the energy, since the disk moves back and forth on its own
// parabola. (vx, vy): velocity relative to the obstacle. Preconditions: gap.beyond >= 0, and the disk approaches.
inline double time_since_obstacle(const Obstacle& o, const ObstacleGap& gap, double r, double vx, double vy,
                                  const Gravity& g) {
  if (gap.flat) return time_since_flat(gap, -(vx * gap.nx + vy * gap.ny), g);
  const double contact = r + o.radius;
  const double distance = contact - gap.beyond;
  const double dx = distance * gap.nx;
  const double dy = distance * gap.ny;
  double ago = std::max(0.0, -touching_time({-dx, -dy, -vx, -vy}, contact));
  if (!g.acts() || ago == HUGE_VAL) return ago;
  for (int step = 0; step < 2; ++step) {
    double x = dx;
    double y = dy;
    double ux = vx;
    double uy = vy;
    drift<true>(x, y, ux, uy, -ago, g);
    const double approach = x * ux + y * uy;
    if (!(approach < 0.0)) return ago;
    ago = std::max(0.0, ago + (x * x + y * y - contact * contact) / (2.0 * approach));
  }
  return ago;
}

}  // namespace carom
