#include "core/measure/energy_gain.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/measure/invariants.hpp"
#include "core/step/window_plan.hpp"

namespace carom {

std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state) {
  return energy_warnings(scene, start, state, energy_of(state.disks, scene.physics.gravity));
}

std::vector<std::string> energy_warnings(const Scene& scene, const RunStart& start, const State& state,
                                         const Energy& now) {
  if (scene.physics.diffusion > 0.0) return {};
  const bool exact = scene.run.method == Method::exact;
  double before = start.energy.total() + state.counters.emitted_energy;
  double moved = before;  // what rounding is to be held against
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
        "the TC model makes disks that lie on the floor hop, and contact_time = {:g} is long against their motion; use "
        "a smaller one",
        *scene.physics.collapse_contact_time);
  }
  if (!exact) why = fmt::format("dt = {:g} is too long; use a smaller dt or --method exact", scene.run.dt);
  return {fmt::format("at the end, time {:g}, the energy is {:.6g} where {:.6g} was put in: {}", state.time, after,
                      before, why)};
}

}  // namespace carom
