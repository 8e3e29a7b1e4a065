// The exact method's contact of a path with an obstacle. Without gravity it is that of two disks; under gravity the
// disk falls and the obstacle does not, so that the distance squared is a polynomial of fourth degree in time. Its
// earliest root is found with certainty, from + - * / and square roots alone: the approach, half its derivative, is
// monotone between the two roots of a quadratic, so that its sign changes, and with them the pieces of time in which
// the disk comes nearer, are bracketed; and so is the contact within such a piece.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/exact_path.hpp"

namespace carom {

// t in [a, b] where value(t) changes sign: value(a) and value(b) have different signs, or one of them is 0. Newton's
// steps where they stay within the bracket, else it is halved; to the last bit, in an order of operations that is
// always the same.
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

// A disk in free fall past an obstacle, the obstacle's centre the origin.
struct FallPast {
  double x, y, vx, vy;  // of the disk now
  double g;             // > 0
  double contact;       // sum of the radii

  double height(double t) const { return y + (vy * t - 0.5 * g * (t * t)); }
  // Distance squared less contact squared.
  double gap2(double t) const {
    const double dx = x + vx * t;
    const double dy = height(t);
    return (dx * dx + dy * dy) - contact * contact;
  }
  // Half the derivative of gap2, a cubic; < 0: the disk comes nearer.
  double approach(double t) const { return (x + vx * t) * vx + height(t) * (vy - g * t); }
  double approach_slope(double t) const {
    const double u = vy - g * t;
    return vx * vx + u * u - g * height(t);
  }
};

// Time from now, >= 0, until the disk touches the obstacle; `never` if not, or if it comes nearer only after `span`
// (time). A disk that comes nearer and overlaps (by rounding) collides now; one that overlaps and recedes, when it has
// come back to where it is.
inline double time_to_contact_falling(const FallPast& fall, double span) {
  const double gap2 = fall.gap2(0.0);
  const double level = gap2 < 0.0 ? gap2 : 0.0;
  const auto gap = [&](double t) { return fall.gap2(t) - level; };
  const auto gap_slope = [&](double t) { return 2.0 * fall.approach(t); };
  const auto approach = [&](double t) { return fall.approach(t); };
  const auto approach_slope = [&](double t) { return fall.approach_slope(t); };
  double here = fall.approach(0.0);
  if (gap2 <= 0.0 && here < 0.0) return 0.0;
  // Where the approach turns, and a time by which the disk falls away for ever.
  const double turns = (fall.vy * fall.vy - 2.0 * (fall.vx * fall.vx)) + 2.0 * fall.g * fall.y;
  const double half = turns > 0.0 ? std::sqrt(turns / 3.0) : 0.0;
  const double turn[2] = {(fall.vy - half) / fall.g, (fall.vy + half) / fall.g};
  double last = turn[1] > 0.0 ? turn[1] : 0.0;
  const double speed = std::sqrt(fall.vx * fall.vx + fall.vy * fall.vy + fall.g * (std::abs(fall.y) + fall.contact));
  for (double step = speed / fall.g; !(fall.approach(last) > 0.0) && step < never; step *= 2.0) last += step;

  double from = 0.0;    // start of the present stretch between two turns
  double nearer = 0.0;  // since when the disk comes nearer, where it does
  for (int k = 0; k < 3; ++k) {
    const double to = k < 2 ? turn[k] : last;
    if (k < 2 && !(turns > 0.0)) continue;
    if (!(to > from)) continue;
    const double there = fall.approach(to);
    if (here < 0.0 && !(there < 0.0)) {
      const double nearest = bracketed_root(approach, approach_slope, from, to);
      if (!(gap(nearest) > 0.0)) return bracketed_root(gap, gap_slope, nearer, nearest);
    } else if (!(here < 0.0) && there < 0.0) {
      nearer = bracketed_root(approach, approach_slope, from, to);
      if (nearer > span) return never;
    }
    from = to;
    here = there;
  }
  return never;
}

// Time from now until a disk touches an obstacle; apart: its place relative to the obstacle's centre.
inline double time_to_obstacle(Vec2 apart, const PathSegment& p, double contact, double g, double span) {
  if (g == 0.0) return time_to_contact({-apart.x, -apart.y, -p.vx, -p.vy}, contact);
  return time_to_contact_falling({apart.x, apart.y, p.vx, p.vy, g, contact}, span);
}

struct ObstacleContact {
  double time = never;         // in the window
  std::uint32_t obstacle = 0;  // its place in State::obstacles
};

// The first contact of a path with an obstacle, the one earlier in the list of two at the same time; `never` if after
// `end`. The path is followed a cell at a time, so that only obstacles near it cost anything; the time is that of the
// whole segment and the obstacle, whatever the cells are. Preconditions: box.obstacles is not null; end is finite.
inline ObstacleContact first_obstacle_contact(const PathSegment& p, double radius, const Domain& box, double g,
                                              double end) {
  const ObstacleCells& obstacles = *box.obstacles;
  const double span = end - p.start;
  ObstacleContact first;
  PathSegment at = p;
  for (double from = 0.0;;) {
    const double speed = std::sqrt(at.vx * at.vx + at.vy * at.vy);
    const double cell = obstacles.cell();
    const double step = 2.0 * cell / (speed + std::sqrt(speed * speed + 2.0 * g * cell));
    const double to = step < span - from ? from + step : span;
    const PathSegment next = carried_to(p, p.start + to, g);
    // A parabola rises above its chord by no more than g t^2 / 8.
    const double reach = radius * (1.0 + 1e-9);
    const double rise = g * (to - from) * (to - from);
    const Vec2 low{std::min(at.x, next.x) - reach, std::min(at.y, next.y) - reach};
    const Vec2 high{std::max(at.x, next.x) + reach, std::max(at.y, next.y) + rise + reach};
    obstacles.visit(low, high, [&](std::uint32_t k, Vec2 shift) {
      const Obstacle& o = obstacles[k];
      const Vec2 apart{(p.x - o.x) - shift.x, (p.y - o.y) - shift.y};
      const double s = p.start + time_to_obstacle(apart, p, radius + o.radius, g, span);
      if (s <= end && (s < first.time || (s == first.time && k < first.obstacle))) first = {s, k};
    });
    if (first.time <= p.start + to || !(to < span) || !(to > from)) return first;
    from = to;
    at = next;
  }
}

}  // namespace carom
