// A plain event-driven simulation with which the exact method is compared: all pairs, all images, long double, no grid,
// no windows, every disk advanced at every event. Written from the formulas, it shares no code with core.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/disks/obstacle.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/oracle_times.hpp"

namespace carom::oracle {

// e(v) = max(least, 1 - viscosity v^(1/5)) for two groups; `least` itself if the viscosity is 0.
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
  std::vector<std::size_t> obstacle_groups;  // of obstacles that are disks
  std::vector<WallMotion> motions;           // of inner walls, by the id of the obstacle
  Surfaces surfaces;
  Real contact_time = 0.0L;  // TC model
  Real time = 0.0L;
  std::size_t collisions = 0;
  std::size_t wall_collisions = 0;
  Real last_event = -HUGE_VALL;
  Real shortest = HUGE_VALL;  // shortest time between two events
  Real no_gap = 0.0L;  // for two that meet again, speed of approach times the time between; smaller values are rounding
  Real undecided = 0.0L;  // largest speed of approach below that
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

// The same with the scene's laws of restitution.
inline System make_system(const Scene& scene, const State& start) {
  System s = make_system(start.disks, scene.box, scene.physics.gravity, scene.physics.restitution, start.obstacles);
  s.viscosity = scene.physics.law.viscosity;
  s.surfaces = scene.physics.surfaces;
  s.contact_time = scene.physics.collapse_contact_time.value_or(0.0);
  for (const InnerWall& wall : scene.walls) s.motions.push_back(wall.motion);
  for (const GroupPair& pair : scene.physics.law.pairs) {
    s.laws.push_back({pair.first, pair.second, pair.restitution.least, pair.restitution.viscosity});
  }
  std::vector<std::size_t> group_of_id;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    group_of_id.insert(group_of_id.end(), scene.groups[g].count, g);
  }
  const std::vector<std::size_t> order = by_id(start.disks);
  for (std::size_t k = 0; k < order.size(); ++k) {
    s.balls[k].group = group_of_id.at(start.disks.id[order[k]]);
    if (s.surfaces.are_rough()) s.balls[k].spin = start.disks.spin[order[k]];
  }
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

// From the system's time on.
inline Way way_of(const System& s, const Obstacle& o) {
  if (!o.is_segment() || o.id >= s.motions.size() || !s.motions[o.id].moves()) return {};
  const WallMotion& motion = s.motions[o.id];
  return {motion.pace, motion.along.x, motion.along.y, s.time};
}

// The obstacle at the system's time, wrapped into the box by its first end. Its place is rounded to double.
inline Obstacle obstacle_now(const System& s, Obstacle o) {
  const Way way = way_of(s, o);
  if (!way.moves()) return o;
  const Real shift = wall_at(way.pace, s.time).inset;
  Real x = o.x + way.along_x * shift;
  Real y = o.y + way.along_y * shift;
  if (s.box.periodic_x()) x -= std::floor(x / s.box.width) * static_cast<Real>(s.box.width);
  if (s.box.periodic_y()) y -= std::floor(y / s.box.height) * static_cast<Real>(s.box.height);
  o.x = static_cast<double>(x);
  o.y = static_cast<double>(y);
  return o;
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
      const Way way = way_of(s, s.obstacles[k]);
      const Obstacle o = obstacle_now(s, s.obstacles[k]);
      const int most = way.moves() ? 2 : 1;  // it may reach across a side
      for (int kx = px ? -most : 0; kx <= (px ? most : 0); ++kx) {
        for (int ky = py ? -most : 0; ky <= (py ? most : 0); ++ky) {
          const Real t_o = obstacle_time(a, o, way, kx * w, ky * h, s.left, s.down, std::min(end, first.time));
          if (t_o < first.time) first = {t_o, i, i, kx * w, ky * h, -1, static_cast<int>(k)};
          unknown = unknown || std::isnan(t_o);
        }
      }
    }
  }
  first.unknown = unknown;
  return first;
}

// Wraps a ball into the box; in a sheared box it becomes the image there.
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

// Notes the contact of two balls that approach at speed `closing` with surface velocity `slip`. Returns true if one of
// them had a contact so recently that the collision is elastic and smooth (TC model).
inline bool meet(System& s, Ball& a, Ball& b, Real closing, Real slip) {
  const Real pause = s.time - std::max(a.last_event, b.last_event);
  const Real gap = std::abs(closing) * pause;
  if (gap < s.no_gap) s.undecided = std::max({s.undecided, std::abs(closing), std::abs(slip)});
  a.last_event = b.last_event = s.time;
  return pause < s.contact_time;
}

// The tangential impulse that turns the slip g into -restitution g, limited by friction. give: the decrease of g for
// each unit of impulse.
inline Real sticking_impulse(const Roughness& surface, Real g, Real give, Real pressed) {
  const Real most = std::isinf(surface.friction) ? HUGE_VALL : static_cast<Real>(surface.friction) * pressed;
  return std::clamp((1.0L + surface.restitution) * g / give, -most, most);
}

// Applies an impulse to the ball's surface at (nx, ny) times its radius, along the tangent to the left of n.
inline void push_surface(const System& s, Ball& b, Real nx, Real ny, Real impulse) {
  b.vx += impulse / b.m * -ny;
  b.vy += impulse / b.m * nx;
  b.spin += impulse * b.r / (static_cast<Real>(s.surfaces.inertia) * b.m * b.r * b.r);
}

// The velocity of the rough surface there along that tangent.
inline Real surface_speed(const System& s, const Ball& b, Real nx, Real ny) {
  return s.surfaces.are_rough() ? -b.vx * ny + b.vy * nx + b.spin * b.r : 0.0L;
}

// The change of that velocity for each unit of impulse.
inline Real surface_give(const System& s, const Ball& b) {
  return 1.0L / b.m + b.r * b.r / (static_cast<Real>(s.surfaces.inertia) * b.m * b.r * b.r);
}

// The ball bounces off an immovable thing at (nx, ny) that has velocity (ux, uy).
inline void bounce(System& s, Ball& a, Real nx, Real ny, Real ux, Real uy, Real restitution, Touching which) {
  // In the frame of that thing, so that with restitution 0 no approach remains.
  const Real wx = a.vx - ux;
  const Real wy = a.vy - uy;
  const Real approach = wx * nx + wy * ny;
  const Real slip = surface_speed(s, a, nx, ny) - (-ux * ny + uy * nx);
  const bool lasts = meet(s, a, a, approach, s.surfaces.of(which).acts() ? slip : 0.0L);
  const Real change = (1.0L + (lasts ? 1.0L : restitution)) * approach;
  a.vx = ux + (wx - change * nx);
  a.vy = uy + (wy - change * ny);
  ++s.wall_collisions;
  if (!s.surfaces.are_rough() || lasts) return;
  push_surface(s, a, nx, ny, -sticking_impulse(s.surfaces.of(which), slip, surface_give(s, a), change * a.m));
}

inline void meet_side(System& s, const Happening& e) {
  Ball& a = s.balls[e.i];
  const auto k = static_cast<std::size_t>(e.side);
  const Real inwards = k % 2 == 0 ? 1.0L : -1.0L;  // along x or y
  const Real u = inwards * wall_at(s.box.motions[k], s.time).speed;
  const bool across_x = k < 2;
  bounce(s, a, across_x ? -inwards : 0.0L, across_x ? 0.0L : -inwards, across_x ? u : 0.0L, across_x ? 0.0L : u,
         s.box.restitutions[k], Touching::wall);
}

inline void meet_obstacle(System& s, const Happening& e) {
  Ball& a = s.balls[e.i];
  const Obstacle o = obstacle_now(s, s.obstacles[static_cast<std::size_t>(e.obstacle)]);
  const Way way = way_of(s, s.obstacles[static_cast<std::size_t>(e.obstacle)]);
  const Wall pace = way.after(0.0L);
  const Real ux = pace.speed * way.along_x;
  const Real uy = pace.speed * way.along_y;
  // The image may have wrapped meanwhile: the nearest one touches.
  Line line{HUGE_VALL, HUGE_VALL};
  for (int kx = -2; kx <= 2; ++kx) {
    for (int ky = -2; ky <= 2; ++ky) {
      if ((kx != 0 && !s.box.periodic_x()) || (ky != 0 && !s.box.periodic_y())) continue;
      const Line image =
          from_obstacle(o, a.x - kx * static_cast<Real>(s.box.width), a.y - ky * static_cast<Real>(s.box.height));
      if (image.x * image.x + image.y * image.y < line.x * line.x + line.y * line.y) line = image;
    }
  }
  const Real d = std::sqrt(line.x * line.x + line.y * line.y);
  const Real nx = -line.x / d;
  const Real ny = -line.y / d;
  const bool by_groups = !o.is_segment() && !s.obstacle_groups.empty();
  const Real restitution = by_groups
                               ? restitution_of(s, a.group, s.obstacle_groups[static_cast<std::size_t>(e.obstacle)],
                                                std::abs((a.vx - ux) * nx + (a.vy - uy) * ny))
                               : static_cast<Real>(o.restitution);
  bounce(s, a, nx, ny, ux, uy, restitution, o.is_segment() ? Touching::wall : Touching::disks);
}

inline void collide(System& s, const Happening& e) {
  Ball& a = s.balls[e.i];
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
  // The second one's surface is at the end of -n, where the tangent is the other way round.
  const Real slip = surface_speed(s, a, nx, ny) + surface_speed(s, b, -nx, -ny) + jump * ny;
  const bool lasts = meet(s, a, b, closing, s.surfaces.disks.acts() ? slip : 0.0L);
  const Real restitution = lasts ? 1.0L : restitution_of(s, a.group, b.group, std::abs(closing));
  const Real impulse = -(1.0L + restitution) * closing * a.m * b.m / (a.m + b.m);
  a.vx -= impulse / a.m * nx;
  a.vy -= impulse / a.m * ny;
  b.vx += impulse / b.m * nx;
  b.vy += impulse / b.m * ny;
  ++s.collisions;
  if (!s.surfaces.are_rough() || lasts) return;
  const Real rub = sticking_impulse(s.surfaces.disks, slip, surface_give(s, a) + surface_give(s, b), impulse);
  push_surface(s, a, nx, ny, -rub);
  push_surface(s, b, -nx, -ny, -rub);
}

inline void resolve(System& s, const Happening& e) {
  if (e.side >= 0) return meet_side(s, e);
  if (e.obstacle >= 0) return meet_obstacle(s, e);
  collide(s, e);
}

// Runs to time t. Returns false if there were more than most_events events, or if the next one is undecided by
// rounding; the system is then at the last event.
inline bool run(System& s, Real t, std::size_t most_events = static_cast<std::size_t>(-1)) {
  std::size_t events = 0;
  for (;;) {
    // Only images one period away are tested, so no disk may move by more than a quarter period between predictions.
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
