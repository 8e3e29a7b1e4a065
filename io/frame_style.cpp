#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/frame.hpp"

namespace carom {

namespace {

// The next of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten: colour-bar numbers that read well.
double round_up(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

// Most of a Maxwell distribution in two dimensions, 99.8 %, lies below this many root mean squares.
constexpr double reach = 2.5;

// Where only a mean square speed can be foretold, the scale ends at this many of it: the tail shares one colour, but
// the rest is not all dark.
constexpr double tail = 2.5;

struct SpeedSquares {
  double mean = 0.0;
  double greatest = 0.0;
};

SpeedSquares speed_squares(const Disks& disks) {
  SpeedSquares s;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double v2 = disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i];
    s.mean += v2;
    s.greatest = std::max(s.greatest, v2);
  }
  if (!disks.empty()) s.mean /= static_cast<double>(disks.size());
  return s;
}

double initial_square(const Disks& disks) {
  const SpeedSquares s = speed_squares(disks);
  return std::min(s.greatest, reach * reach * s.mean);
}

// Mean square speed once collisions have shared the energy out: 2 kT / m with kT = K / N, averaged over the disks. 0
// for disks of one mass, where it says nothing new.
double shared_square(const Disks& disks) {
  double kinetic = 0.0, inverse_mass = 0.0, least = 0.0, greatest = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double mass = disks.mass_of(i);
    kinetic += 0.5 * mass * (disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i]);
    inverse_mass += 1.0 / mass;
    least = i == 0 ? mass : std::min(least, mass);
    greatest = std::max(greatest, mass);
  }
  const auto n = static_cast<double>(disks.size());
  return least == greatest ? 0.0 : 2.0 * (kinetic / n) * (inverse_mass / n);
}

// What falling to the floor adds, on average.
double falling_square(const Disks& disks, double gravity) {
  double height = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) height += std::max(disks.y[i] - disks.radius_of(i), 0.0);
  return disks.empty() ? 0.0 : 2.0 * gravity * height / static_cast<double>(disks.size());
}

double source_square(const Source& source) {
  if (source.velocities.kind == VelocityLaw::Kind::uniform)
    return 2.0 * source.velocities.limit * source.velocities.limit;
  if (source.velocities.kind != VelocityLaw::Kind::maxwell) return 0.0;
  // A mass that is not a constant is of the order of the numbers that describe it.
  const double mass = source.mass.kind == SizeLaw::Kind::uniform    ? source.mass.low
                      : source.mass.kind == SizeLaw::Kind::constant ? source.mass.value
                                                                    : 1.0;
  return mass > 0.0 ? tail * 2.0 * source.velocities.temperature / mass : 0.0;
}

// So many decimals that multiples of the frame interval differ and are shown exactly, up to four.
int decimals_for(double every, double t_end) {
  const double interval = every > 0.0 ? every : t_end;
  if (!(interval >= 1e-4 && t_end < 1e7)) return -1;
  int decimals = 0;
  for (double scaled = interval; decimals < 4 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled;
       scaled *= 10.0) {
    ++decimals;
  }
  return decimals;
}

}  // namespace

FrameStyle frame_style(const std::string& title, const Domain& box, const Disks& first) {
  return {title, box, round_up(std::sqrt(std::max(initial_square(first), tail * shared_square(first)))), 2};
}

FrameStyle frame_style(const Scene& scene, const Disks& first) {
  const Physics& physics = scene.physics;
  const bool elastic = physics.restitution == 1.0;
  double square = initial_square(first);
  if (elastic) square = std::max(square, tail * shared_square(first));
  if (physics.gravity > 0.0) square += falling_square(first, physics.gravity);
  for (const Source& source : scene.sources) square = std::max(square, source_square(source));
  if (physics.diffusion > 0.0 && scene.run.dt > 0.0) {
    const double brownian = 4.0 * physics.diffusion / scene.run.dt;  // mean of (u / dt)^2, both components
    square = physics.accumulate ? square + brownian : tail * brownian;
  }
  return {scene.title, scene.box, round_up(std::sqrt(square)), decimals_for(scene.output.every, scene.run.t_end)};
}

}  // namespace carom
