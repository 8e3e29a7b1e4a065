// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011, from Random123): a number is a function of
// (seed, stream, disk id, step), never of what was drawn before.
#pragma once

#include <cstdint>

#include "core/base/types.hpp"

namespace carom {

// Every use of random numbers has its own stream, so that adding one never shifts another.
enum class Stream : std::uint32_t {
  radius = 1,
  mass,
  position,
  velocity,
  brownian,
  sink_crossing,
  source_place,
  source_velocity,
  source_radius,
  source_mass,
  growth_velocity,
  thermal_side,
  thermostat,
  thermostat_choice,
  spin,
  source_spin,
};

struct TwoUniforms {
  double a, b;  // each in (0, 1), odd multiples of 2^-53
};

// Two independent uniforms for (seed, stream, id, step, attempt). attempt < 256.
TwoUniforms uniforms(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t step, std::uint32_t attempt = 0);

// Two independent standard normal deviates (polar method of Marsaglia, with deterministic_log in place of libm's).
Vec2 normals(std::uint64_t seed, Stream stream, DiskId id, std::uint64_t step);

// A standard normal deviate, drawn again until it lies within this many standard deviations; one draw in 16,000 does
// not. So the radii of a run have bounds that its cells and checks can rely on.
inline constexpr double most_deviations = 4.0;
double bounded_normal(std::uint64_t seed, Stream stream, DiskId id);

// Natural logarithm from + - * / only, so that every IEEE machine gives the same bits; relative error below 4e-16.
// Precondition: x > 0, finite, normal.
double deterministic_log(double x);

// e^x, likewise; relative error below 4e-16. Precondition: |x| <= 700.
double deterministic_exp(double x);

}  // namespace carom
