// The exact method: when a path touches an obstacle. Without gravity this is the contact of two disks. Under gravity
// the disk falls and the obstacle does not, so the squared distance is a polynomial of fourth degree in time. Its
// earliest root is found with certainty, from + - * / and square roots alone: the approach, half its derivative, is
// monotone between the two roots of a quadratic. That brackets its sign changes, hence the intervals of time in which
// the disk comes nearer, and within each of them the contact.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/exact_path.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/physics/swinging_wall.hpp"

namespace carom {

// t in [a, b] where value(t) changes sign. Precondition: value(a) and value(b) have different signs, or one of them is
// 0. Takes Newton steps as long as they stay within the bracket, and halves it otherwise, until t no longer changes.
// slope(t): the derivative of value.
template <class Value, class Slope>
double bracketed_root(Value&& value, Slope&& slope, double a, double b) {
  constexpr int most_halvings = 200;
  const bool starts_above = value(a) > 0.0;
  double t = 0.5 * (a + b);
  for (int step = 0; step < most_halvings; ++step) {
    const double here = value(t);
    ((here > 0.0) == starts_above ? a : b) = t;
    double next = t - here / slope(t);
    if (next == t) break;
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (!(next > a && next < b)) break;
    t = next;
  }
  return t;
}

// A disk in free fall past a round obstacle whose centre is the origin.
struct FallPast {
  double x, y, vx, vy;  // of the disk now
  Gravity g;            // not 0
  double contact;       // sum of the radii

  double across(double t) const { return x + (vx * t - 0.5 * g.left * (t * t)); }
  double height(double t) const { return y + (vy * t - 0.5 * g.down * (t * t)); }
  // Distance squared less contact squared.
  double gap2(double t) const {
    const double dx = across(t);
    const double dy = height(t);
    return (dx * dx + dy * dy) - contact * contact;
  }
  // Half the derivative of gap2, a cubic; < 0: the disk comes nearer.
  double approach(double t) const { return across(t) * (vx - g.left * t) + height(t) * (vy - g.down * t); }
  double approach_slope(double t) const {
    const double ux = vx - g.left * t;
    const double uy = vy - g.down * t;
    return ux * ux + uy * uy - g.against(across(t), height(t));
  }
};

// The two times at which the approach has an extremum; none if `real` is false.
struct ApproachTurns {
  bool real;
  double time[2];
};

// The roots of approach_slope, a quadratic: (u -+ sqrt((u^2 - 2 v^2 + 2 g h) / 3)) / g. Here u is the speed and h the
// height, both against gravity, and v the speed across it.
inline ApproachTurns turns_of(const FallPast& fall) {
  const double size = fall.g.size;
  const double up_x = fall.g.left / size;
  const double up_y = fall.g.down / size;
  const double rising = up_y * fall.vy + up_x * fall.vx;
  const double passing = up_y * fall.vx - up_x * fall.vy;
  const double height = up_y * fall.y + up_x * fall.x;
  const double turns = (rising * rising - 2.0 * (passing * passing)) + 2.0 * size * height;
  const double half = turns > 0.0 ? std::sqrt(turns / 3.0) : 0.0;
  return {turns > 0.0, {(rising - half) / size, (rising + half) / size}};
}

// A time, not before `after`, from which on the disk recedes for ever.
inline double falls_away_by(const FallPast& fall, double after) {
  const double size = fall.g.size;
  const double far = std::abs(fall.g.down / size * fall.y + fall.g.left / size * fall.x) + fall.contact;
  const double speed = std::sqrt(fall.vx * fall.vx + fall.vy * fall.vy + size * far);
  double last = after > 0.0 ? after : 0.0;
  for (double step = speed / size; !(fall.approach(last) > 0.0) && step < never; step *= 2.0) last += step;
  return last;
}

// Is a distance `away` (length) more than can be covered within `span` (time) at this speed and acceleration? The
// margin is far above the rounding of a contact's time.
inline bool is_out_of_reach(double away, double speed, double acceleration, double span) {
  constexpr double margin = 1.0 + 1e-6;
  return away > margin * span * (speed + 0.5 * acceleration * span);
}

// Time from now, >= 0, until the disk touches the obstacle; `never` if it does not. May return `never` for a contact
// after `span` (time). A disk that approaches and overlaps (by rounding) collides now; one that overlaps and recedes
// collides when it is as deep again.
inline double time_to_contact_falling(const FallPast& fall, double span) {
  const double gap2 = fall.gap2(0.0);
  const double level = gap2 < 0.0 ? gap2 : 0.0;
  const auto gap = [&](double t) { return fall.gap2(t) - level; };
  const auto gap_slope = [&](double t) { return 2.0 * fall.approach(t); };
  const auto approach = [&](double t) { return fall.approach(t); };
  const auto approach_slope = [&](double t) { return fall.approach_slope(t); };
  double here = fall.approach(0.0);
  if (gap2 <= 0.0 && here < 0.0) return 0.0;
  const double away = std::sqrt(fall.x * fall.x + fall.y * fall.y) - fall.contact * (1.0 + 1e-6);
  if (is_out_of_reach(away, std::sqrt(fall.vx * fall.vx + fall.vy * fall.vy), fall.g.size, span)) return never;
  const ApproachTurns turns = turns_of(fall);
  const double last = falls_away_by(fall, turns.time[1]);

  double from = 0.0;    // start of the present interval between two turns
  double nearer = 0.0;  // when the present approach began, if there is one
  for (int k = 0; k < 3; ++k) {
    const double to = k < 2 ? turns.time[k] : last;
    if (k < 2 && !turns.real) continue;
    if (!(to > from)) continue;
    const double there = fall.approach(to);
    if (here < 0.0 && !(there < 0.0)) {
      const double nearest = bracketed_root(approach, approach_slope, from, to);
      // A disk that gravity presses on the obstacle is in contact already when it begins to approach.
      if (!(gap(nearer) > 0.0)) return nearer;
      if (!(gap(nearest) > 0.0)) return bracketed_root(gap, gap_slope, nearer, nearest);
    } else if (!(here < 0.0) && there < 0.0) {
      nearer = here > 0.0 ? bracketed_root(approach, approach_slope, from, to) : from;
      if (nearer > span) return never;
    }
    from = to;
    here = there;
  }
  return never;
}

// Time from now until a disk touches a fixed disk or an end of a segment. apart: position relative to its centre, or to
// that end.
inline double time_to_round(Vec2 apart, const PathSegment& p, double contact, const Gravity& g, double span) {
  if (!g.acts()) return time_to_contact({-apart.x, -apart.y, -p.vx, -p.vy}, contact);
  return time_to_contact_falling({apart.x, apart.y, p.vx, p.vy, g, contact}, span);
}

// Time until a disk `gap` away from a plane touches it from outside. speed, a: velocity and acceleration towards the
// plane. gap < 0: the disk is beyond. A disk that is beyond only by rounding (is_touching) and recedes touches again
// when it is as far beyond as now.
inline double time_to_plane(double gap, double speed, double a, bool is_touching) {
  if (speed > 0.0) {
    if (is_touching) return 0.0;
    const double discriminant = speed * speed + 2.0 * a * gap;
    if (gap < 0.0 || discriminant < 0.0) return never;
    return 2.0 * gap / (speed + std::sqrt(discriminant));
  }
  if (!(a > 0.0)) return never;
  if (is_touching) return 2.0 * -speed / a;
  const double discriminant = speed * speed + 2.0 * a * gap;
  return discriminant < 0.0 ? never : (std::sqrt(discriminant) - speed) / a;
}

// Time until a disk of this radius touches a segment between its ends, on the side to which n points.
inline double time_to_flat(const Obstacle& o, Vec2 apart, Vec2 n, const PathSegment& p, double radius,
                           const Gravity& g) {
  const double length = std::sqrt(o.dx * o.dx + o.dy * o.dy);
  const double ux = o.dx / length;
  const double uy = o.dy / length;
  const auto is_inside = [&](double t) {
    const double along =
        (apart.x + (p.vx * t - 0.5 * g.left * (t * t))) * ux + (apart.y + (p.vy * t - 0.5 * g.down * (t * t))) * uy;
    return along >= 0.0 && along <= length;
  };
  const double across = apart.x * n.x + apart.y * n.y;
  const double gap = across - radius;
  const bool is_touching = gap <= 0.0 && across >= 0.0 && is_inside(0.0);
  const double t = time_to_plane(gap, -(p.vx * n.x + p.vy * n.y), g.against(n.x, n.y), is_touching);
  return t < never && is_inside(t) ? t : never;
}

// Time until a disk of this radius touches an obstacle at rest: a round one, or either side or end of a segment. A sink
// takes a disk that touches it, even if the disk recedes.
inline double time_to_obstacle(const Obstacle& o, Vec2 apart, const PathSegment& p, double radius, const Gravity& g,
                               double span) {
  if (!o.is_segment()) return time_to_round(apart, p, radius + o.radius, g, span);
  const ShortestLine now = shortest_line(o, apart);
  if (o.kind == ObstacleKind::sink && now.distance <= radius) return 0.0;
  // A disk beside the segment that never comes nearer. If it slides along the segment, rounding would find a contact
  // with the end.
  const bool comes_nearer = p.vx * now.line.x + p.vy * now.line.y < 0.0 || g.against(now.line.x, now.line.y) > 0.0;
  if (now.flat && !comes_nearer) return never;
  const double length = std::sqrt(o.dx * o.dx + o.dy * o.dy);
  const Vec2 n{-(o.dy / length), o.dx / length};
  const double flat =
      std::min(time_to_flat(o, apart, n, p, radius, g), time_to_flat(o, apart, {-n.x, -n.y}, p, radius, g));
  const double ends = std::min(time_to_round(apart, p, radius, g, span),
                               time_to_round({apart.x - o.dx, apart.y - o.dy}, p, radius, g, span));
  return std::min(flat, ends);
}

// The same for a moving wall; `never` if it is out of reach. In the wall's frame the disk falls with the difference of
// the accelerations, which is constant within a window unless the wall vibrates as a sine. apart: of the disk from the
// wall's place at time 0.
[[gnu::noinline, gnu::cold]] inline double time_to_moving_wall(const Obstacle& o, Vec2 apart, const PathSegment& p,
                                                               double radius, const Domain& box, const Gravity& g,
                                                               double span) {
  const WallMotion& motion = box.obstacles->motion_of(o);
  const SidePlace pace = motion.pace_at(box.clock, p.start);
  const Vec2 from_wall{apart.x - motion.along.x * pace.inset, apart.y - motion.along.y * pace.inset};
  const double away = shortest_line(o, from_wall).distance - (radius + o.radius) * (1.0 + 1e-6);
  if (motion.is_sine()) {
    const double speed = std::sqrt(p.vx * p.vx + p.vy * p.vy) + motion.largest_speed();
    if (is_out_of_reach(away, speed, g.size, span)) return never;
    return time_to_swinging_wall({o, motion, pace}, apart, p, radius, g, span);
  }
  const PathSegment seen{p.start, p.x, p.y, p.vx - motion.along.x * pace.speed, p.vy - motion.along.y * pace.speed};
  const Gravity felt(g.left + motion.along.x * pace.acceleration, g.down + motion.along.y * pace.acceleration);
  const double speed = std::sqrt(seen.vx * seen.vx + seen.vy * seen.vy);
  if (is_out_of_reach(away, speed, felt.size, span)) return never;
  return time_to_obstacle(o, from_wall, seen, radius, felt, span);
}

// Does the rectangle around an obstacle's image overlap this one?
inline bool may_reach(const Obstacle& o, Vec2 shift, Vec2 low, Vec2 high) {
  const double x = o.x + shift.x;
  const double y = o.y + shift.y;
  return x + std::max(o.dx, 0.0) + o.radius >= low.x && x + std::min(o.dx, 0.0) - o.radius <= high.x &&
         y + std::max(o.dy, 0.0) + o.radius >= low.y && y + std::min(o.dy, 0.0) - o.radius <= high.y;
}

// The least time in which a disk covers a distance > 0 at this speed and with an acceleration of this size.
inline double least_time_over(double distance, double speed, double acceleration) {
  return 2.0 * distance / (speed + std::sqrt(speed * speed + 2.0 * acceleration * distance));
}

struct ObstacleContact {
  double time = never;         // in the window
  std::uint32_t obstacle = 0;  // its place in State::obstacles
};

// The first contact of a path with an obstacle by `end`; of two at the same time, the one earlier in the list. The path
// is followed in pieces, as far as the way is known to be clear or else a cell at a time, so that only obstacles near
// it are tested; each test uses the whole segment, so the cells do not change the time. near_start(k, shift) is called
// for every obstacle k, and every image of it displaced by shift, within `margin` (length) of the disk at the path's
// start, and perhaps for others. Preconditions: box.obstacles is not null and follows the window; end is finite.
template <class NearStart>
ObstacleContact first_obstacle_contact(const PathSegment& p, double radius, const Domain& box, const Gravity& g,
                                       double end, double margin, NearStart&& near_start) {
  const ObstacleCells& obstacles = *box.obstacles;
  const double span = span_until(p.start, end);
  // A sink that lies along a wall or a side is an opening in it: a disk that touches both at one moment is taken.
  // Rounding might put the wall first, so a sink takes disks from this distance on.
  const double grip = obstacles.has_sinks() ? place_slack(box, radius) : 0.0;
  const double cell = obstacles.cell();
  const double reach = radius + 1e-9 * (radius + cell) + std::max(grip, margin);
  // A clear way shorter than this share of a cell is not used: a step by a whole cell is cheaper.
  constexpr double least_clear = 0.1;
  ObstacleContact first;
  PathSegment at = p;
  for (double from = 0.0;;) {
    const double speed = std::sqrt(at.vx * at.vx + at.vy * at.vy);
    const double clear = obstacles.clearance({at.x, at.y}) - reach;
    const bool is_clear = clear > least_clear * cell;
    const double step = least_time_over(is_clear ? clear : cell, speed, g.size);
    const double to = step < span - from ? from + step : span;
    const PathSegment next = carried_to(p, p.start + to, g);
    // A parabola lies off its chord, on the side that gravity points away from, by no more than g t^2 / 8.
    const double rise_x = g.left * (to - from) * (to - from);
    const double rise_y = g.down * (to - from) * (to - from);
    const Vec2 low{std::min(at.x, next.x) + std::min(rise_x, 0.0) - reach,
                   std::min(at.y, next.y) + std::min(rise_y, 0.0) - reach};
    const Vec2 high{std::max(at.x, next.x) + std::max(rise_x, 0.0) + reach,
                    std::max(at.y, next.y) + std::max(rise_y, 0.0) + reach};
    const auto see = [&](std::uint32_t k, Vec2 shift) {
      const Obstacle& o = obstacles[k];
      if (!o.moves && !may_reach(o, shift, low, high)) return;
      if (from == 0.0) near_start(k, shift);
      const Vec2 apart{(p.x - o.x) - shift.x, (p.y - o.y) - shift.y};
      const double r = o.kind == ObstacleKind::sink ? radius + grip : radius;
      const double s = p.start + (o.moves ? time_to_moving_wall(o, apart, p, r, box, g, span)
                                          : time_to_obstacle(o, apart, p, r, g, span));
      if (s <= end && (s < first.time || (s == first.time && k < first.obstacle))) first = {s, k};
    };
    if (!is_clear && !obstacles.is_clear(low, high)) obstacles.visit(low, high, see);
    if (first.time <= p.start + to || !(to < span) || !(to > from)) return first;
    from = to;
    at = next;
  }
}
inline ObstacleContact first_obstacle_contact(const PathSegment& p, double radius, const Domain& box, const Gravity& g,
                                              double end) {
  return first_obstacle_contact(p, radius, box, g, end, 0.0, [](std::uint32_t, Vec2) {});
}

}  // namespace carom
