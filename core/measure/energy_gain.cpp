#include "core/measure/energy_gain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/measure/invariants.hpp"
#include "core/step/window_plan.hpp"

namespace carom {

namespace {

// May disks of negative energy have left, so that the energy of the others is larger than that at the start?
bool may_lose_negative(const Scene& scene, const State& state) {
  const Gravity& g = scene.physics.gravity;
  return state.counters.removed > 0 && (g.left < 0.0 || g.down < 0.0);
}

}  // namespace

bool falls_for_ever(const Scene& scene) {
  const Gravity& g = scene.physics.gravity;
  return (g.left != 0.0 && scene.box.periodic_x()) || (g.down != 0.0 && scene.box.periodic_y());
}

std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state) {
  return energy_warnings(scene, start, state, energy_of(state.disks, scene.physics.gravity));
}

std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state,
                                         const Energy& now) {
  if (scene.physics.diffusion > 0.0 || falls_for_ever(scene) || may_lose_negative(scene, state)) return {};
  const bool exact = scene.run.method == Method::exact;
  const double emitted = state.counters.emitted_energy;
  double before = start.energy.total() + emitted;
  // The scale of rounding. Potential energies may be negative, since they are 0 at the lower left corner.
  double moved = start.energy.kinetic + std::abs(start.energy.potential) + start.energy.rotational + std::abs(emitted);
  for (const double heat : state.counters.side_energy) {
    before += heat;
    moved += std::abs(heat);
  }
  for (const double given : {state.counters.thermostat_heat, state.counters.shear_work, state.counters.wall_work}) {
    before += given;
    moved += std::abs(given);
  }
  const double after = now.total();
  if (!(after - before > (exact ? most_gain_exact : most_gain_stepping) * moved)) return {};
  std::string why = "speeds or sizes differ too much for double precision";
  if (exact && has_tc(scene)) {
    why = fmt::format(
        "the TC model makes disks hop that lie on the floor, and contact_time = {:g} is long against their motion; use "
        "a smaller one",
        *scene.physics.collapse_contact_time);
  }
  if (!exact) why = fmt::format("dt = {:g} is too long; use a smaller dt or run.method = \"exact\"", scene.run.dt);
  return {fmt::format("at the end, at time {:g}, the energy is {:.6g}, but only {:.6g} was put in: {}", state.time,
                      after, before, why)};
}

}  // namespace carom
