// Times to the next contact of a ball of the oracle (event_oracle.hpp) with another ball, a side or an obstacle, in
// long double. Written from the formulas, sharing no code with core.
#pragma once

// clang, unlike g++, warns of conversions from double to long double, which are intended here.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/disks/domain.hpp"
#include "core/disks/obstacle.hpp"

namespace carom::oracle {

using Real = long double;

struct Ball {
  Real x, y, vx, vy, r, m;
  std::size_t group = 0;  // its [[disks]] block
  Real last_event = -HUGE_VALL;
  Real spin = 0.0L;
};

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

// The inset of a side, its speed and its acceleration, from the formulas of its motion.
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

// The motion of an obstacle from its present place (x, y) on; without a pace it is at rest.
struct Way {
  SideMotion pace{};
  Real along_x = 0.0L, along_y = 0.0L;
  Real now = 0.0L;
  bool moves() const { return pace.kind != SideMotion::Kind::none; }
  // Its displacement after time t, its speed then, and a bound on its acceleration.
  Wall after(Real t) const {
    const Wall then = wall_at(pace, now + t);
    return {then.inset - wall_at(pace, now).inset, then.speed, then.acceleration};
  }
  Real most_acceleration() const {
    const Real size = std::sqrt(along_x * along_x + along_y * along_y);
    const auto period = static_cast<Real>(pace.period);
    if (pace.kind == SideMotion::Kind::sine)
      return size * 4.0L * std::acos(-1.0L) * std::acos(-1.0L) / (period * period);
    return pace.kind == SideMotion::Kind::parabolas ? size * 32.0L / (period * period) : 0.0L;
  }
};

// Time of contact of a falling ball with an obstacle displaced by (ox, oy), up to `end`, by steps within which the ball
// certainly does not touch. NaN if that takes very many steps: the ball then slides along the obstacle, and rounding
// decides whether it touches.
inline Real obstacle_time(const Ball& a, const Obstacle& o, const Way& way, Real ox, Real oy, Real left, Real down,
                          Real end) {
  const Real g = std::sqrt(left * left + down * down) + way.most_acceleration();
  const Real reach = a.r + static_cast<Real>(o.radius);
  const Real nothing = 1e-17L * reach;
  constexpr int most_steps = 100'000;
  Real t = 0.0L;
  for (int step = 0; step < most_steps; ++step) {
    const bool first = step == 0;
    const Wall wall = way.after(t);
    const auto [x, y] = from_obstacle(o, a.x + a.vx * t - 0.5L * left * t * t - wall.inset * way.along_x - ox,
                                      a.y + a.vy * t - 0.5L * down * t * t - wall.inset * way.along_y - oy);
    const Real vx = a.vx - left * t - wall.speed * way.along_x;
    const Real vy = a.vy - down * t - wall.speed * way.along_y;
    const Real gap = std::sqrt(x * x + y * y) - reach;
    const bool nearer = x * vx + y * vy < 0.0L;
    if (gap <= nothing && nearer) return t;
    if (first && g == 0.0L && !nearer) return no_event;
    if (t >= end) return no_event;
    // Leaves a contact that has just ended by slightly more than rounding.
    const Real room = std::max(gap, (nearer ? 1e-18L : 1e-13L) * reach);
    const Real speed = std::sqrt(vx * vx + vy * vy);
    t += 2.0L * room / (speed + std::sqrt(speed * speed + 2.0L * g * room));
  }
  return std::numeric_limits<Real>::quiet_NaN();
}

// The same for a side that vibrates as a sine, up to `end`, by steps within which no acceleration could bring the two
// together.
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

// The displacement of the images above a sheared box at time t.
inline Real shear_offset(const Domain& box, Real t) {
  const Real jump = static_cast<Real>(box.shear.rate) * static_cast<Real>(box.height);
  return jump == 0.0L ? 0.0L : std::remainder(jump * t, static_cast<Real>(box.width));
}

}  // namespace carom::oracle
