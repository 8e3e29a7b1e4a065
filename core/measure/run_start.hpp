// What is remembered of the start of a run, for the summary at its end.
#pragma once

#include "core/disks/state.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct RunStart {
  Count particles = 0;
  double time = 0.0;
  Energy energy;
  Momentum momentum;
};

inline RunStart run_start(const State& state, const Scene& scene) {
  return {state.disks.size(), state.time, energy_of(state.disks, scene.physics.gravity), momentum_of(state.disks)};
}

}  // namespace carom
