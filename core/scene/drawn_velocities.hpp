// Brownian disks have no velocity: the u / dt of a step is a displacement that was drawn for it, and grows as dt
// shrinks.
#pragma once

#include <algorithm>

#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Are velocities those of drawn displacements, so that energy, momentum, pressure and forces mean nothing? Not with
// accumulate, which adds up velocities as the program of docs/original.md does.
inline bool velocities_are_drawn(const Scene& scene) {
  return scene.physics.diffusion > 0.0 && !scene.physics.accumulate;
}

// Does nothing in the scene give momentum to the disks or take it away?
inline bool keeps_momentum(const Scene& scene) {
  return scene.box.periodic_x() && scene.box.periodic_y() && !scene.box.shear.acts() && !scene.physics.gravity.acts() &&
         !(scene.physics.diffusion > 0.0) && !scene.physics.thermostat.acts() && scene.sources.empty() &&
         scene.walls.empty() &&
         std::none_of(scene.groups.begin(), scene.groups.end(), [](const DiskGroup& g) { return g.fixed; });
}

}  // namespace carom
