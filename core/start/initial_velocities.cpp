#include "core/start/initial_velocities.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/input_message.hpp"
#include "core/base/random.hpp"
#include "core/physics/roughness.hpp"
#include "core/start/placement.hpp"

namespace carom {

namespace {

// The disks of one group, [first, last).
struct Range {
  std::size_t first = 0;
  std::size_t last = 0;
};

void remove_mean_velocity(Disks& d, Range range) {
  GroupMomentum sum;
  for (std::size_t i = range.first; i < range.last; ++i) sum.add(d.mass_of(i), {d.vx[i], d.vy[i]});
  const Vec2 mean = sum.mean_velocity();
  for (std::size_t i = range.first; i < range.last; ++i) {
    d.vx[i] -= mean.x;
    d.vy[i] -= mean.y;
  }
}

void scale_to_energy(Disks& d, Range range, double energy) {
  double kinetic = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) {
    kinetic += 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
  }
  const double factor = std::sqrt(energy / kinetic);
  for (std::size_t i = range.first; i < range.last; ++i) {
    d.vx[i] *= factor;
    d.vy[i] *= factor;
  }
}

void set_maxwell(const Scene& scene, double temperature, Disks& d, Range range) {
  if (temperature == 0.0) return;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Vec2 velocity = maxwell_velocity(scene, temperature, d.id[i], d.mass_of(i));
    d.vx[i] = velocity.x;
    d.vy[i] = velocity.y;
  }
  remove_mean_velocity(d, range);
  scale_to_energy(d, range, static_cast<double>(range.last - range.first) * temperature);
}

void set_uniform(const Scene& scene, double limit, Disks& d, Range range) {
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Vec2 velocity = uniform_velocity(scene, limit, d.id[i]);
    d.vx[i] = velocity.x;
    d.vy[i] = velocity.y;
  }
}

void add_drift(Vec2 drift, Disks& d, Range range) {
  if (drift == Vec2{}) return;
  for (std::size_t i = range.first; i < range.last; ++i) {
    d.vx[i] += drift.x;
    d.vy[i] += drift.y;
  }
}

// Draws spins and scales them so that the mean of I w^2 is T.
void set_thermal_spins(const Scene& scene, double temperature, Disks& d, Range range) {
  double twice_energy = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) {
    d.spin[i] = thermal_spin(scene, temperature, d.id[i], d.inertia, d.mass_of(i), d.radius_of(i));
    twice_energy += 2.0 * rotational_energy(d.inertia, d.mass_of(i), d.radius_of(i), d.spin[i]);
  }
  const double factor = std::sqrt(static_cast<double>(range.last - range.first) * temperature / twice_energy);
  for (std::size_t i = range.first; i < range.last; ++i) d.spin[i] *= factor;
}

void set_spins_of_group(const Scene& scene, const SpinLaw& law, Disks& d, Range range) {
  if (law.temperature > 0.0) return set_thermal_spins(scene, law.temperature, d, range);
  for (std::size_t i = range.first; i < range.last; ++i) {
    d.spin[i] = law.list.empty() ? law.value : law.list[i - range.first];
  }
}

void check_finite(const Scene& scene, std::size_t group, const Disks& d, Range range) {
  for (std::size_t i = range.first; i < range.last; ++i) {
    if (std::isfinite(d.vx[i]) && std::isfinite(d.vy[i])) continue;
    fail_input(place_in_group(scene, group, "velocities"),
               fmt::format("disk {} gets velocity ({}, {})", i, d.vx[i], d.vy[i]), "expected finite numbers");
  }
}

}  // namespace

Vec2 maxwell_velocity(const Scene& scene, double temperature, DiskId id, double mass) {
  const Vec2 normal = normals(scene.seed, Stream::velocity, id, 0);
  const double speed = std::sqrt(temperature / mass);
  return {normal.x * speed, normal.y * speed};
}

Vec2 uniform_velocity(const Scene& scene, double limit, DiskId id) {
  const TwoUniforms u = uniforms(scene.seed, Stream::velocity, id, 0);
  return {limit * (2.0 * u.a - 1.0), limit * (2.0 * u.b - 1.0)};
}

double thermal_spin(const Scene& scene, double temperature, DiskId id, double inertia, double mass, double radius) {
  const double scale = std::sqrt(temperature / (inertia * mass)) / radius;
  return scale * normals(scene.seed, Stream::spin, id, 0).x;
}

void set_velocities(const Scene& scene, Disks& d) {
  d.vx.assign(d.size(), 0.0);
  d.vy.assign(d.size(), 0.0);
  Range range;
  for (std::size_t g = 0; g < scene.groups.size(); ++g, range.first = range.last) {
    const VelocityLaw& law = scene.groups[g].velocities;
    range.last = range.first + static_cast<std::size_t>(scene.groups[g].count);
    if (range.first == range.last) continue;
    if (law.kind == VelocityLaw::Kind::maxwell) set_maxwell(scene, law.temperature, d, range);
    if (law.kind == VelocityLaw::Kind::uniform) set_uniform(scene, law.limit, d, range);
    if (law.kind == VelocityLaw::Kind::list) {
      for (std::size_t k = 0; k < law.list.size(); ++k) {
        d.vx[range.first + k] = law.list[k].x;
        d.vy[range.first + k] = law.list[k].y;
      }
    }
    add_drift(scene.groups[g].drift, d, range);
    check_finite(scene, g, d, range);
  }
}

void set_spins(const Scene& scene, Disks& d) {
  d.inertia = scene.physics.surfaces.inertia;
  if (!d.spins()) return;
  d.spin.assign(d.size(), 0.0);
  Range range;
  for (const DiskGroup& group : scene.groups) {
    range.last = range.first + static_cast<std::size_t>(group.count);
    if (range.first < range.last) set_spins_of_group(scene, group.spins, d, range);
    range.first = range.last;
  }
}

}  // namespace carom
