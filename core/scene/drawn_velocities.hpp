// Scenes whose velocities are not physical: with Brownian motion the velocity u / dt of a step stands for a random
// displacement u, and grows as dt shrinks.
#pragma once

#include <algorithm>

#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Do velocities stand for random displacements, so that energy, momentum, pressure and forces have no meaning? Not with
// accumulate, which adds up velocities as the program of docs/original.md does.
inline bool velocities_are_drawn(const Scene& scene) {
  return scene.physics.diffusion > 0.0 && !scene.physics.accumulate;
}

// Is the momentum of the disks conserved?
inline bool keeps_momentum(const Scene& scene) {
  return scene.box.periodic_x() && scene.box.periodic_y() && !scene.box.shear.acts() && !scene.physics.gravity.acts() &&
         !(scene.physics.diffusion > 0.0) && !scene.physics.thermostat.acts() && scene.sources.empty() &&
         scene.walls.empty() &&
         std::none_of(scene.groups.begin(), scene.groups.end(), [](const DiskGroup& g) { return g.fixed; });
}

}  // namespace carom
