// Draws the Brownian velocities of a step, in parallel.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Draws those of step number `step`, of length dt, for all disks; returns the largest squared speed. scratch: any
// vector.
double draw_velocities(Disks& disks, const Scene& scene, double dt, Count step, const Executor& executor,
                       std::vector<double>& scratch);

}  // namespace carom
