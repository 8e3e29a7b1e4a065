// A scene or a state in other units of length, mass and time.
#pragma once

#include <cmath>
#include <vector>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom::test {

// Powers of two, so that scaling a number is exact.
struct Units {
  double length = 1.0, mass = 1.0, time = 1.0;
  double speed() const { return length / time; }
  double energy() const { return mass * speed() * speed(); }
};

// Of a power of 2^5, exactly.
inline double fifth_root_of(double unit) {
  return std::ldexp(1.0, std::ilogb(unit) / 5);
}

inline void scale(std::vector<double>& values, double unit) {
  for (double& v : values) v *= unit;
}

inline void scale(Vec2& v, double unit) {
  v = {v.x * unit, v.y * unit};
}

inline void scale(SizeLaw& law, double unit, double density_unit) {
  law.value *= unit;
  scale(law.values, unit);
  law.low *= unit;
  law.high *= unit;
  law.density *= density_unit;
  if (law.kind == SizeLaw::Kind::normal) law.deviation *= unit;  // a lognormal law has that of the logarithm
}

inline void scale(VelocityLaw& law, const Units& u) {
  law.temperature *= u.energy();
  law.limit *= u.speed();
  for (Vec2& v : law.list) scale(v, u.speed());
}

inline void scale(SpinLaw& law, const Units& u) {
  law.value /= u.time;
  scale(law.list, 1.0 / u.time);
  law.temperature *= u.energy();
}

inline void scale(PositionLaw& law, double unit) {
  for (Vec2& p : law.list) scale(p, unit);
  if (!law.region) return;
  for (Vec2* corner : {&law.region->low, &law.region->high, &law.region->centre}) scale(*corner, unit);
  law.region->radius *= unit;
}

inline void scale_sides(Domain& box, const Units& u) {
  for (double& temperature : box.temperatures) temperature *= u.energy();
  for (SideMotion& motion : box.motions) {
    for (double* length : {&motion.inset, &motion.amplitude, &motion.furthest}) *length *= u.length;
    motion.speed *= u.speed();
    motion.period *= u.time;
  }
  for (SidePlace& place : box.places) {
    place = {place.inset * u.length, place.speed * u.speed(), place.acceleration * u.speed() / u.time};
  }
}

inline Scene scaled(Scene s, const Units& u) {
  const double density = u.mass / (u.length * u.length);
  s.box.width *= u.length;
  s.box.height *= u.length;
  scale_sides(s.box, u);
  s.box.shear = {s.box.shear.rate / u.time, s.box.shear.jump * u.speed(), s.box.shear.offset * u.length};
  const double acceleration = u.speed() / u.time;
  s.physics.gravity = {s.physics.gravity.left * acceleration, s.physics.gravity.down * acceleration};
  s.physics.diffusion *= u.length * u.length / u.time;
  const double viscosity = 1.0 / fifth_root_of(u.speed());
  s.physics.law.viscosity *= viscosity;
  for (GroupPair& pair : s.physics.law.pairs) pair.restitution.viscosity *= viscosity;
  s.physics.thermostat.temperature *= u.energy();
  s.physics.thermostat.rate /= u.time;
  s.physics.thermostat.dt *= u.time;
  for (DiskGroup& g : s.groups) {
    scale(g.positions, u.length);
    scale(g.velocities, u);
    scale(g.drift, u.speed());
    scale(g.spins, u);
    scale(g.radius, u.length, density);
    scale(g.mass, u.mass, density);
  }
  for (InnerWall& wall : s.walls) {
    for (Vec2& point : wall.points) scale(point, u.length);
    scale(wall.motion.along, wall.motion.pace.vibrates() ? u.length : u.speed());
    wall.motion.pace.period *= u.time;
  }
  for (Source& source : s.sources) {
    scale(source.region_low, u.length);
    scale(source.region_high, u.length);
    source.rate /= u.time;
    scale(source.radius, u.length, density);
    scale(source.mass, u.mass, density);
    scale(source.velocities, u);
    scale(source.spins, u);
  }
  s.run.dt *= u.time;
  s.run.t_end *= u.time;
  return s;
}

inline State scaled(State state, const Units& u) {
  Disks& d = state.disks;
  scale(d.x, u.length);
  scale(d.y, u.length);
  scale(d.vx, u.speed());
  scale(d.vy, u.speed());
  scale(d.radius, u.length);
  scale(d.mass, u.mass);
  scale(d.spin, 1.0 / u.time);
  d.common_radius *= u.length;
  d.common_mass *= u.mass;
  state.time *= u.time;
  state.counters.disk_time *= u.time;
  state.counters.disk_time_excess *= u.time;
  state.counters.virial *= u.mass * u.speed() * u.length;
  state.counters.emitted_energy *= u.energy();
  for (double& impulse : state.counters.wall_impulse) impulse *= u.mass * u.speed();
  for (double& energy : state.counters.side_energy) energy *= u.energy();
  state.counters.thermostat_heat *= u.energy();
  state.counters.shear_virial *= u.mass * u.speed() * u.length;
  state.counters.shear_work *= u.energy();
  state.counters.wall_work *= u.energy();
  for (double& push : state.counters.wall_push) push *= u.mass * u.speed();
  for (Obstacle& obstacle : state.obstacles) {
    for (double* length : {&obstacle.x, &obstacle.y, &obstacle.dx, &obstacle.dy, &obstacle.radius}) *length *= u.length;
  }
  for (ContactLoad& load : state.loads) load.force *= u.mass * u.speed() / u.time;
  return state;
}

}  // namespace carom::test
