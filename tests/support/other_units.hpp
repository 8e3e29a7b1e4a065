// A scene or a state in other units of length, mass and time.
#pragma once

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
}

inline void scale(VelocityLaw& law, const Units& u) {
  law.temperature *= u.energy();
  law.limit *= u.speed();
  for (Vec2& v : law.list) scale(v, u.speed());
}

inline Scene scaled(Scene s, const Units& u) {
  const double density = u.mass / (u.length * u.length);
  s.box.width *= u.length;
  s.box.height *= u.length;
  s.physics.gravity *= u.length / (u.time * u.time);
  s.physics.diffusion *= u.length * u.length / u.time;
  for (DiskGroup& g : s.groups) {
    for (Vec2& p : g.positions.list) scale(p, u.length);
    scale(g.velocities, u);
    scale(g.radius, u.length, density);
    scale(g.mass, u.mass, density);
  }
  for (Source& source : s.sources) {
    scale(source.region_low, u.length);
    scale(source.region_high, u.length);
    source.rate /= u.time;
    scale(source.radius, u.length, density);
    scale(source.mass, u.mass, density);
    scale(source.velocities, u);
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
  d.common_radius *= u.length;
  d.common_mass *= u.mass;
  state.time *= u.time;
  state.counters.virial *= u.mass * u.speed() * u.length;
  for (double& impulse : state.counters.wall_impulse) impulse *= u.mass * u.speed();
  for (ContactLoad& load : state.loads) load.force *= u.mass * u.speed() / u.time;
  return state;
}

}  // namespace carom::test
