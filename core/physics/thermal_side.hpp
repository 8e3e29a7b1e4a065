// A side that is kept at a temperature: a disk that reaches it leaves with a velocity drawn from Maxwell's flux
// distribution, as if a gas of that temperature flowed out of a hole in the wall.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/random.hpp"
#include "core/physics/boundary.hpp"
#include "core/physics/roughness.hpp"

namespace carom {

// A velocity drawn from the flux distribution.
struct FluxVelocity {
  double away = 0.0;   // from the wall, > 0; length / time
  double along = 0.0;  // the wall
  double more = 0.0;   // one more standard normal deviate
};

// Maxwell's flux distribution: away from the wall the density is v exp(-v^2 / (2 s^2)) / s^2 (the root of the sum of
// two normal deviates squared), along it normal. scale: s = sqrt(T / m), length / time. Drawn by (seed, stream, id,
// number).
inline FluxVelocity flux_velocity(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t number, double scale) {
  const Vec2 a = normals(seed, stream, id, 2 * number);
  const Vec2 b = normals(seed, stream, id, 2 * number + 1);
  return {scale * std::sqrt(a.x * a.x + a.y * a.y), scale * b.x, b.y};
}

// Sets the velocity of a disk that leaves this side.
inline void leave_side(Side side, const FluxVelocity& v, double& vx, double& vy) {
  const bool vertical = side == Side::left || side == Side::right;
  const double away = side == Side::left || side == Side::bottom ? v.away : -v.away;
  vx = vertical ? away : v.along;
  vy = vertical ? v.along : away;
}

// The draws of thermal sides depend on the seed, the disk and the number of its thermal reflections so far. So they are
// the same in every engine, on any number of threads, with any step or window.
struct ThermalDraw {
  std::uint64_t seed = 0;
  DiskId id = 0;
  std::uint32_t hits = 0;  // before this one
};

struct ThermalReflection {
  double energy = 0.0;   // that the side gave to the disk; mass length^2 / time^2
  double deviate = 0.0;  // standard normal, of the same draw
};

// Gives a disk of this mass, which moves towards the side, a velocity away from it drawn at this temperature.
inline ThermalReflection reflect_thermally(Side side, double temperature, double mass, const ThermalDraw& draw,
                                           double& vx, double& vy) {
  const double before = vx * vx + vy * vy;
  const double scale = std::sqrt(temperature / mass);
  const FluxVelocity drawn = flux_velocity(draw.seed, Stream::thermal_side, draw.id, draw.hits, scale);
  leave_side(side, drawn, vx, vy);
  return {0.5 * mass * ((vx * vx + vy * vy) - before), drawn.more};
}

// A rough thermal side draws the spin anew, too. normal: a standard normal deviate. Returns the energy given to the
// rotation.
inline double spin_thermally(double inertia, double temperature, double mass, double radius, double normal,
                             double& spin) {
  const double before = rotational_energy(inertia, mass, radius, spin);
  spin = normal * (std::sqrt(temperature / (inertia * mass)) / radius);
  return rotational_energy(inertia, mass, radius, spin) - before;
}

}  // namespace carom
