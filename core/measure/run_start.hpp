// Figures of the start of a run, for the summary at its end.
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
  double relative = 0.0;  // kinetic energy relative to the flow of a sheared box; in other boxes, the kinetic energy
};

RunStart run_start(const State& state, const Scene& scene);

}  // namespace carom
