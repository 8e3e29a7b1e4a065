// Paths in single precision: enough to tell in passing who cannot meet whom.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/exact_path.hpp"

namespace carom {

// A path carried back to the start of the window, in a frame that falls with gravity: place and velocity there, in
// SketchUnits. A fourth of a cache line, so those of a whole block of disks stay at hand.
struct PathSketch {
  float x = 0.0F, y = 0.0F, vx = 0.0F, vy = 0.0F;
};

// Powers of two; they keep squares of anything usual within the range of a float.
struct SketchUnits {
  double length = 1.0;  // in the units of the scene
  double time = 1.0;
  double gravity = 0.0;
  double per_length = 1.0, per_speed = 1.0, per_time = 1.0;  // reciprocals

  PathSketch sketch(const PathSegment& p) const {
    const double s = p.start;
    return {static_cast<float>((p.x - p.vx * s) * per_length),
            static_cast<float>((p.y - (p.vy + 0.5 * gravity * s) * s) * per_length),
            static_cast<float>(p.vx * per_speed), static_cast<float>((p.vy + gravity * s) * per_speed)};
  }
};

// Units for disks of this radius (length) and speeds up to this (v^2).
inline SketchUnits sketch_units(double largest_radius, double fastest2, double gravity) {
  const auto power = [](double a) { return a > 0.0 && std::isfinite(a) ? std::ldexp(1.0, std::ilogb(a)) : 1.0; };
  const double length = power(largest_radius);
  const double speed = power(std::sqrt(fastest2));
  return {length, length / speed, gravity, 1.0 / length, 1.0 / speed, speed / length};
}

}  // namespace carom
