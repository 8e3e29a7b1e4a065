#include "core/measure/run_start.hpp"

#include "core/measure/shear_flow.hpp"

namespace carom {

RunStart run_start(const State& state, const Scene& scene) {
  RunStart start;
  start.particles = state.disks.size();
  start.time = state.time;
  start.energy = energy_of(state.disks, scene.physics.gravity);
  start.momentum = momentum_of(state.disks);
  start.relative = start.energy.kinetic;
  if (scene.box.shear.acts()) start.relative = energy_of(relative_to_flow(state.disks, scene.box), Gravity{}).kinetic;
  return start;
}

}  // namespace carom
