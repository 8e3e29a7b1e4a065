// A plain event-driven simulation to hold the exact method against: all pairs, all images, long double, no grid, no
// windows, every disk advanced at every event. Written from the formulas, sharing no code with core.
#pragma once

// clang, unlike g++, calls every step from double to the oracle's long double a promotion by mistake; here it is the
// point.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/disks/obstacle.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom::oracle {

using Real = long double;

struct Ball {
  Real x, y, vx, vy, r, m;
  std::size_t group = 0;  // its [[disks]] block
  Real last_event = -HUGE_VALL;
};

// e(v) = max(least, 1 - viscosity v^(1/5)) of two groups; least itself where the viscosity is 0.
struct GroupLaw {
  std::size_t first = 0, second = 0;
  Real least = 1.0L, viscosity = 0.0L;
};

struct System {
  std::vector<Ball> balls;
  std::vector<Obstacle> obstacles;
  Domain box;
  Real left = 0.0L, down = 0.0L;  // gravity
  Real restitution = 1.0L, viscosity = 0.0L;
  std::vector<GroupLaw> laws;
  std::vector<std::size_t> obstacle_groups;  // of those that are disks
  Real time = 0.0L;
  std::size_t collisions = 0;
  std::size_t wall_collisions = 0;
  Real last_event = -HUGE_VALL;
  Real shortest = HUGE_VALL;  // time between two events
  Real no_gap = 0.0L;         // of two that meet again, speed of approach times the time between: below it, rounding
  Real undecided = 0.0L;      // largest speed of approach across less than that
};

inline System make_system(const Disks& disks, const Domain& box, const Gravity& gravity, double restitution,
                          const std::vector<Obstacle>& obstacles = {}) {
  System s;
  s.obstacles = obstacles;
  s.box = box;
  s.left = gravity.left;
  s.down = gravity.down;
  s.restitution = restitution;
  for (const std::size_t i : by_id(disks)) {
    s.balls.push_back({disks.x[i], disks.y[i], disks.vx[i], disks.vy[i], disks.radius_of(i), disks.mass_of(i)});
  }
  return s;
}

// The same with all that the scene says of restitutions.
inline System make_system(const Scene& scene, const State& start) {
  System s = make_system(start.disks, scene.box, scene.physics.gravity, scene.physics.restitution, start.obstacles);
  s.viscosity = scene.physics.law.viscosity;
  for (const GroupPair& pair : scene.physics.law.pairs) {
    s.laws.push_back({pair.first, pair.second, pair.restitution.least, pair.restitution.viscosity});
  }
  std::vector<std::size_t> group_of_id;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    group_of_id.insert(group_of_id.end(), scene.groups[g].count, g);
  }
  const std::vector<std::size_t> order = by_id(start.disks);
  for (std::size_t k = 0; k < order.size(); ++k) s.balls[k].group = group_of_id.at(start.disks.id[order[k]]);
  for (const Obstacle& o : start.obstacles) {
    s.obstacle_groups.push_back(o.is_segment() ? 0 : group_of_id.at(o.id));
  }
  return s;
}

inline Real restitution_of(const System& s, std::size_t g, std::size_t h, Real speed) {
  Real least = s.restitution;
  Real viscosity = s.viscosity;
  for (const GroupLaw& law : s.laws) {
    if ((law.first != g || law.second != h) && (law.first != h || law.second != g)) continue;
    least = law.least;
    viscosity = law.viscosity;
  }
  return viscosity == 0.0L ? least : std::max(least, 1.0L - viscosity * std::pow(speed, 0.2L));
}

inline constexpr Real no_event = HUGE_VALL;

// Contact of two balls, the second displaced by (ox, oy).
inline Real pair_time(const Ball& a, const Ball& b, Real ox, Real oy) {
  const Real dx = b.x + ox - a.x;
  const Real dy = b.y + oy - a.y;
  const Real ux = b.vx - a.vx;
  const Real uy = b.vy - a.vy;
  const Real along = dx * ux + dy * uy;
  if (along >= 0.0L) return no_event;
  const Real u2 = ux * ux + uy * uy;
  const Real reach = a.r + b.r;
  const Real gap2 = dx * dx + dy * dy - reach * reach;
  if (gap2 <= 0.0L) return 0.0L;
  const Real discriminant = along * along - u2 * gap2;
  return discriminant < 0.0L ? no_event : gap2 / (-along + std::sqrt(discriminant));
}

// First t >= 0 at which distance d to a side, closing at speed u with acceleration a towards it, is covered.
inline Real side_time(Real d, Real u, Real a) {
  if (d < 0.0L) d = 0.0L;
  if (a == 0.0L) return u > 0.0L ? d / u : no_event;
  const Real discriminant = u * u + 2.0L * a * d;
  if (discriminant < 0.0L || (a < 0.0L && u <= 0.0L)) return no_event;
  const Real root = std::sqrt(discriminant);
  return u > 0.0L ? 2.0L * d / (u + root) : (-u + root) / a;
}

// From the nearest point of an obstacle displaced by (ox, oy) to (x, y).
struct Line {
  Real x, y;
};
inline Line from_obstacle(const Obstacle& o, Real x, Real y) {
  const Real dx = o.dx;
  const Real dy = o.dy;
  const Real length2 = dx * dx + dy * dy;
  x -= static_cast<Real>(o.x);
  y -= static_cast<Real>(o.y);
  const Real share = length2 > 0.0L ? std::clamp((x * dx + y * dy) / length2, 0.0L, 1.0L) : 0.0L;
  return {x - share * dx, y - share * dy};
}

// Contact of a falling ball with an obstacle displaced by (ox, oy), up to `end`, by going on as far as the ball surely
// does not touch yet. NaN where that takes very many steps: the ball slides along the obstacle, and whether it touches
// rounding decides.
inline Real obstacle_time(const Ball& a, const Obstacle& o, Real ox, Real oy, Real left, Real down, Real end) {
  const Real g = std::sqrt(left * left + down * down);
  const Real reach = a.r + static_cast<Real>(o.radius);
  const Real nothing = 1e-17L * reach;
  constexpr int most_steps = 100'000;
  Real t = 0.0L;
  for (int step = 0; step < most_steps; ++step) {
    const bool first = step == 0;
    const auto [x, y] =
        from_obstacle(o, a.x + a.vx * t - 0.5L * left * t * t - ox, a.y + a.vy * t - 0.5L * down * t * t - oy);
    const Real vx = a.vx - left * t;
    const Real vy = a.vy - down * t;
    const Real gap = std::sqrt(x * x + y * y) - reach;
    const bool nearer = x * vx + y * vy < 0.0L;
    if (gap <= nothing && nearer) return t;
    if (first && g == 0.0L && !nearer) return no_event;
    if (t >= end) return no_event;
    // Away from a contact that is over by a little, beyond the reach of rounding.
    const Real room = std::max(gap, (nearer ? 1e-18L : 1e-13L) * reach);
    const Real speed = std::sqrt(vx * vx + vy * vy);
    t += 2.0L * room / (speed + std::sqrt(speed * speed + 2.0L * g * room));
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// How far a side has come into the box, how fast it comes, and its acceleration, from the formulas of its motion.
struct Wall {
  Real inset = 0.0L, speed = 0.0L, acceleration = 0.0L;
  Real lasts = HUGE_VALL;  // time until the next piece of the motion
};

inline Wall wall_at(const SideMotion& m, Real t) {
  if (m.kind == SideMotion::Kind::none) return {};
  const auto inset = static_cast<Real>(m.inset);
  if (m.kind == SideMotion::Kind::steady) {
    const auto u = static_cast<Real>(m.speed);
    return {inset + u * t, u, 0.0L};
  }
  if (m.kind == SideMotion::Kind::sine) {
    const Real w = 2.0L * std::acos(-1.0L) / static_cast<Real>(m.period);
    const auto a = static_cast<Real>(m.amplitude);
    return {inset + a * std::sin(w * t), a * w * std::cos(w * t), -a * w * w * std::sin(w * t)};
  }
  const Real half = 0.5L * static_cast<Real>(m.period);
  Real k = std::floor(t / half);
  Real since = t - k * half;
  if (half - since < 1e-15L * half) {
    k += 1.0L;
    since = 0.0L;
  }
  const Real up = std::fmod(k, 2.0L) == 0.0L ? 1.0L : -1.0L;
  const Real rate = up * 4.0L * static_cast<Real>(m.amplitude) / (half * half);
  return {inset + rate * since * (half - since), rate * (half - 2.0L * since), -2.0L * rate, half - since};
}

// Likewise with a side that is a sine, up to `end`, by going on as far as no acceleration could bring the two together.
inline Real sine_time(const SideMotion& m, Real now, Real d, Real u, Real g, Real end) {
  const Real w = 2.0L * std::acos(-1.0L) / static_cast<Real>(m.period);
  const Real most = std::abs(static_cast<Real>(m.amplitude)) * w * w + std::abs(g);
  const Real nothing = 1e-18L * (std::abs(d) + std::abs(static_cast<Real>(m.inset)));
  Real t = 0.0L;
  while (t <= end) {
    const Wall wall = wall_at(m, now + t);
    const Real gap = d - u * t - 0.5L * g * t * t - wall.inset;
    const Real closing = u + g * t + wall.speed;
    if (gap <= nothing && closing > 0.0L) return t;
    const Real room = std::max(gap, 1e-17L * std::abs(static_cast<Real>(m.amplitude)));
    t += std::max(side_time(room, closing, most), 1e-15L * static_cast<Real>(m.period));
  }
  return no_event;
}

// Of the images above a sheared box: how far they are displaced at time t.
inline Real shear_offset(const Domain& box, Real t) {
  const Real jump = static_cast<Real>(box.shear.rate) * static_cast<Real>(box.height);
  return jump == 0.0L ? 0.0L : std::remainder(jump * t, static_cast<Real>(box.width));
}

struct Happening {
  Real time = no_event;
  std::size_t i = 0, j = 0;
  Real ox = 0.0L, oy = 0.0L;
  int side = -1;
  int obstacle = -1;
  bool unknown = false;  // obstacle_time
};

inline Happening next_happening(const System& s, Real end) {
  Happening first;
  bool unknown = false;
  const bool px = s.box.periodic_x();
  const bool py = s.box.periodic_y();
  const Real offset = shear_offset(s.box, s.time);
  const int most_x = !px ? 0 : s.box.shear.acts() ? 2 : 1;
  for (std::size_t i = 0; i < s.balls.size(); ++i) {
    const Ball& a = s.balls[i];
    for (std::size_t j = i + 1; j < s.balls.size(); ++j) {
      for (int kx = -most_x; kx <= most_x; ++kx) {
        for (int ky = py ? -1 : 0; ky <= (py ? 1 : 0); ++ky) {
          const Real ox = kx * static_cast<Real>(s.box.width) + ky * offset;
          const Real oy = ky * static_cast<Real>(s.box.height);
          Ball b = s.balls[j];
          b.vx += ky * static_cast<Real>(s.box.shear.rate) * static_cast<Real>(s.box.height);
          const Real t = pair_time(a, b, ox, oy);
          if (t < first.time) first = {t, i, j, ox, oy, -1};
        }
      }
    }
    const Real w = s.box.width;
    const Real h = s.box.height;
    Wall m[4];
    for (std::size_t k = 0; k < 4; ++k) m[k] = wall_at(s.box.motions[k], s.time);
    const auto time = [&](int k, Real gap, Real speed, Real g) {
      const SideMotion& motion = s.box.motions[static_cast<std::size_t>(k)];
      if (motion.kind == SideMotion::Kind::sine) return sine_time(motion, s.time, gap, speed, g, end);
      return side_time(gap - m[k].inset, speed + m[k].speed, g + m[k].acceleration);
    };
    const Real t[4] = {
        px ? no_event : time(0, a.x - a.r, -a.vx, s.left), px ? no_event : time(1, w - a.r - a.x, a.vx, -s.left),
        py ? no_event : time(2, a.y - a.r, -a.vy, s.down), py ? no_event : time(3, h - a.r - a.y, a.vy, -s.down)};
    for (int k = 0; k < 4; ++k) {
      if (t[k] < first.time) first = {t[k], i, i, 0.0L, 0.0L, k};
    }
    for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
      for (int kx = px ? -1 : 0; kx <= (px ? 1 : 0); ++kx) {
        for (int ky = py ? -1 : 0; ky <= (py ? 1 : 0); ++ky) {
          const Real t_o = obstacle_time(a, s.obstacles[k], kx * w, ky * h, s.left, s.down, std::min(end, first.time));
          if (t_o < first.time) first = {t_o, i, i, kx * w, ky * h, -1, static_cast<int>(k)};
          unknown = unknown || std::isnan(t_o);
        }
      }
    }
  }
  first.unknown = unknown;
  return first;
}

// Back into a box at this time: across the sides of a sheared one as the image that is there.
inline void wrap_ball(Ball& b, const Domain& box, Real offset) {
  if (box.periodic_y()) {
    const Real rows = std::floor(b.y / box.height);
    b.y -= rows * static_cast<Real>(box.height);
    b.x -= rows * offset;
    b.vx -= rows * static_cast<Real>(box.shear.rate) * static_cast<Real>(box.height);
  }
  if (box.periodic_x()) b.x -= std::floor(b.x / box.width) * static_cast<Real>(box.width);
}

inline void advance(System& s, Real t) {
  const Real offset = shear_offset(s.box, s.time + t);
  for (Ball& b : s.balls) {
    b.x += b.vx * t - 0.5L * s.left * t * t;
    b.y += b.vy * t - 0.5L * s.down * t * t;
    b.vx -= s.left * t;
    b.vy -= s.down * t;
    wrap_ball(b, s.box, offset);
  }
  s.time += t;
}

// Two that approach at this speed.
inline void meet(System& s, Ball& a, Ball& b, Real closing) {
  const Real gap = std::abs(closing) * (s.time - std::max(a.last_event, b.last_event));
  if (gap < s.no_gap) s.undecided = std::max(s.undecided, std::abs(closing));
  a.last_event = b.last_event = s.time;
}

inline void resolve(System& s, const Happening& e) {
  Ball& a = s.balls[e.i];
  if (e.side >= 0) {
    const auto k = static_cast<std::size_t>(e.side);
    const Real u = (k % 2 == 0 ? 1.0L : -1.0L) * wall_at(s.box.motions[k], s.time).speed;  // along x or y
    Real& v = e.side < 2 ? a.vx : a.vy;
    meet(s, a, a, v - u);
    v = u - static_cast<Real>(s.box.restitutions[k]) * (v - u);
    ++s.wall_collisions;
    return;
  }
  if (e.obstacle >= 0) {
    const Obstacle& o = s.obstacles[static_cast<std::size_t>(e.obstacle)];
    // The image may have wrapped meanwhile: the nearest one touches.
    Line line{HUGE_VALL, HUGE_VALL};
    for (int kx = -1; kx <= 1; ++kx) {
      for (int ky = -1; ky <= 1; ++ky) {
        if ((kx != 0 && !s.box.periodic_x()) || (ky != 0 && !s.box.periodic_y())) continue;
        const Line image =
            from_obstacle(o, a.x - kx * static_cast<Real>(s.box.width), a.y - ky * static_cast<Real>(s.box.height));
        if (image.x * image.x + image.y * image.y < line.x * line.x + line.y * line.y) line = image;
      }
    }
    const auto [x, y] = line;
    const Real along = (x * a.vx + y * a.vy) / (x * x + y * y);
    const bool by_groups = !o.is_segment() && !s.obstacle_groups.empty();
    const Real restitution = by_groups
                                 ? restitution_of(s, a.group, s.obstacle_groups[static_cast<std::size_t>(e.obstacle)],
                                                  std::abs(along) * std::sqrt(x * x + y * y))
                                 : static_cast<Real>(o.restitution);
    meet(s, a, a, along * std::sqrt(x * x + y * y));
    a.vx -= (1.0L + restitution) * along * x;
    a.vy -= (1.0L + restitution) * along * y;
    ++s.wall_collisions;
    return;
  }
  Ball& b = s.balls[e.j];
  // The image may have wrapped meanwhile: the nearest one touches.
  Real dx = b.x - a.x;
  Real dy = b.y - a.y;
  Real jump = 0.0L;  // of the second one's image
  if (s.box.periodic_y()) {
    const Real rows = std::round(dy / s.box.height);
    dy -= rows * static_cast<Real>(s.box.height);
    dx -= rows * shear_offset(s.box, s.time);
    jump = -rows * static_cast<Real>(s.box.shear.rate) * static_cast<Real>(s.box.height);
  }
  if (s.box.periodic_x()) dx -= std::round(dx / s.box.width) * static_cast<Real>(s.box.width);
  const Real d = std::sqrt(dx * dx + dy * dy);
  const Real nx = dx / d;
  const Real ny = dy / d;
  const Real closing = (b.vx + jump - a.vx) * nx + (b.vy - a.vy) * ny;
  const Real restitution = restitution_of(s, a.group, b.group, std::abs(closing));
  meet(s, a, b, closing);
  const Real impulse = -(1.0L + restitution) * closing * a.m * b.m / (a.m + b.m);
  a.vx -= impulse / a.m * nx;
  a.vy -= impulse / a.m * ny;
  b.vx += impulse / b.m * nx;
  b.vy += impulse / b.m * ny;
  ++s.collisions;
}

// Runs to time t. False: there were more than so many events before, or nothing can be said of the next one; the system
// is at the last of them.
inline bool run(System& s, Real t, std::size_t most_events = static_cast<std::size_t>(-1)) {
  std::size_t events = 0;
  for (;;) {
    // Only images one period away are tested, so no disk may fly further than a quarter of it between predictions.
    Real longest = no_event;
    for (const Ball& b : s.balls) {
      if (s.box.periodic_x()) longest = std::min(longest, 0.25L * s.box.width / (std::abs(b.vx) + 1e-300L));
      if (s.box.periodic_y()) longest = std::min(longest, 0.25L * s.box.height / (std::abs(b.vy) + 1e-300L));
    }
    if (s.box.shear.acts()) {
      const Real speed = std::abs(static_cast<Real>(s.box.shear.rate) * static_cast<Real>(s.box.height));
      longest = std::min(longest, 0.25L * static_cast<Real>(s.box.width) / speed);
    }
    for (const SideMotion& motion : s.box.motions) longest = std::min(longest, wall_at(motion, s.time).lasts);
    const Real left = t - s.time;
    const Happening e = next_happening(s, std::min(left, longest));
    if (e.unknown) return false;
    if (e.time > left && left <= longest) {
      advance(s, left);
      return true;
    }
    if (e.time > longest) {
      advance(s, longest);
    } else {
      if (++events > most_events) return false;
      advance(s, e.time);
      resolve(s, e);
      s.shortest = std::min(s.shortest, s.time - s.last_event);
      s.last_event = s.time;
    }
  }
}

}  // namespace carom::oracle
