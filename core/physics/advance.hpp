// Motion of one disk between collisions: straight or in a parabola, forwards and backwards, and Brownian. Formulas
// (14), (15), (20), (21), (24): docs/original.md.
#pragma once

#include <cmath>

#include "core/base/random.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"

namespace carom {

// (14), (15); with gravity (20), (21). Exact for any t, negative too: drift by t and by -t cancel to rounding. The +
// 0.0 keeps the sign of a zero velocity: where t < 0 and g.down is 0, the product is -0, and -0 - (-0) is +0.
template <bool gravity>
inline void drift(double& x, double& y, double& vx, double& vy, double t, const Gravity& g) {
  if constexpr (gravity) {
    if (g.is_tilted()) [[unlikely]] {
      x += vx * t - 0.5 * g.left * (t * t);
      vx -= g.left * t;
    } else {
      x += vx * t;
    }
    y += vy * t - 0.5 * g.down * (t * t);
    vy -= g.down * t + 0.0;
  } else {
    x += vx * t;
    y += vy * t;
  }
}

// Brings a centre back into the box across periodic sides. Precondition: it lies outside by less than a period.
template <bool periodic_x, bool periodic_y>
inline void wrap(double& x, double& y, const Domain& box) {
  if constexpr (periodic_x) x = wrap(x, box.width);
  if constexpr (periodic_y) y = wrap(y, box.height);
}

// The same for a box whose periodic sides are known only at run time.
inline void wrap(double& x, double& y, const Domain& box) {
  if (box.periodic_x()) x = wrap(x, box.width);
  if (box.periodic_y()) y = wrap(y, box.height);
}

// Root mean square of a component of the Brownian velocity u / dt of one step; length / time.
inline double brownian_speed(double diffusion, double dt) {
  return std::sqrt(2.0 * diffusion * dt) / dt;
}

// Brownian velocity of one step, (24): u / dt with u = sqrt(2 D dt) (r_x, r_y), r standard normal by (seed, id, step).
inline Vec2 brownian_velocity(std::uint64_t seed, DiskId id, std::uint64_t step, double diffusion, double dt) {
  const Vec2 r = normals(seed, Stream::brownian, id, step);
  const double scale = brownian_speed(diffusion, dt);
  return {scale * r.x, scale * r.y};
}

}  // namespace carom
