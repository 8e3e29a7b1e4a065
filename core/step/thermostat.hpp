// Thermostats: they keep disks at a temperature by kicks at times k dt, between which disks fly and collide freely.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/base/exact_sum.hpp"
#include "core/base/random.hpp"
#include "core/disks/disk_view.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Time between two kicks: the thermostat's own, or that of the run's steps.
inline double kick_interval(const Scene& scene) {
  return scene.physics.thermostat.interval(scene.run.dt);
}

// When the next kick is due; the first at 0. Precondition: the scene has a thermostat.
inline double next_kick(const Scene& scene, const State& state) {
  return static_cast<double>(state.intervals) * kick_interval(scene);
}

// The relative rounding of the times k dt, and of the time of the disks, is less than this.
inline constexpr double kick_rounding = 1e-12;

// Is there another kick in the run? A kick that is due at its end, up to rounding, does not count: no motion follows
// it.
inline bool kicks_again(const Scene& scene, const State& state) {
  return scene.physics.thermostat.acts() && next_kick(scene, state) < (1.0 - kick_rounding) * scene.run.t_end;
}

// Is a kick due at the start of this window, step or frame? Steps need not end at the times of kicks: a kick comes with
// the first step that starts at its time or later, up to rounding.
inline bool is_kick_due(const Scene& scene, const State& state) {
  return kicks_again(scene, state) && state.time >= (1.0 - kick_rounding) * next_kick(scene, state);
}

// A kick changes v to kept v + sqrt(T / m) drawn r, r standard normal. As kept^2 + drawn^2 = 1, Maxwell's distribution
// is stationary for any dt. Langevin: kept = (1 - q) / (1 + q) with q = rate dt / 2, which is e^(-rate dt) to second
// order and needs no exponential. Andersen: kept 0, drawn 1, for the share rate dt of the disks.
struct Kick {
  double kept = 1.0, drawn = 0.0;
};

inline Kick langevin_kick(double rate, double dt) {
  const double q = 0.5 * rate * dt;
  return {(1.0 - q) / (1.0 + q), 2.0 * std::sqrt(q) / (1.0 + q)};
}

// The kick of the scene's thermostat.
inline Kick kick_of(const Scene& scene) {
  const Thermostat& bath = scene.physics.thermostat;
  return bath.kind == Thermostat::Kind::andersen ? Kick{0.0, 1.0} : langevin_kick(bath.rate, kick_interval(scene));
}

// The share of the disks that are kicked: those whose uniform number of Stream::thermostat_choice is below it.
inline double kicked_share(const Scene& scene) {
  const Thermostat& bath = scene.physics.thermostat;
  return bath.kind == Thermostat::Kind::andersen ? bath.rate * kick_interval(scene) : 1.0;
}

// Kicks disk i with the deviates r of Stream::thermostat; returns the energy that it gains. In a sheared box the kick
// acts on the velocity relative to the flow, while the energy is that in the frame of the box.
template <class View>
double kick_disk(const View& d, const Scene& scene, const Kick& kick, std::size_t i, Vec2 r) {
  const double scale = kick.drawn * std::sqrt(scene.physics.thermostat.temperature / d.mass(i));
  const double before = d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i];
  if (scene.box.shear.acts()) [[unlikely]] {
    const double flow = scene.box.shear.flow(d.y[i], scene.box.height);
    d.vx[i] = flow + (kick.kept * (d.vx[i] - flow) + scale * r.x);
  } else {
    d.vx[i] = kick.kept * d.vx[i] + scale * r.x;
  }
  d.vy[i] = kick.kept * d.vy[i] + scale * r.y;
  return 0.5 * d.mass(i) * ((d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]) - before);
}

// Kicks the disks one after another, if a kick is due.
inline void kick_if_due(const Scene& scene, State& state) {
  if (!is_kick_due(scene, state)) return;
  const Count number = state.intervals++;
  const Kick kick = kick_of(scene);
  const double share = kicked_share(scene);
  ExactSum heat;
  with_view(state.disks, [&](const auto& d) {
    for (std::size_t i = 0; i < state.disks.size(); ++i) {
      if (share < 1.0 && !(uniforms(scene.seed, Stream::thermostat_choice, d.id[i], number).a < share)) continue;
      heat.add(kick_disk(d, scene, kick, i, normals(scene.seed, Stream::thermostat, d.id[i], number)));
    }
  });
  state.counters.thermostat_heat += heat.value();
}

}  // namespace carom
