// The start of a scene with moving sides: disks are placed between them.
#pragma once

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The scene in the smaller box between its moving sides at time 0, as sides at rest; coordinates are those of that box.
// Throws InputError if a region reaches beyond a side.
Scene inside_moving_sides(const Scene& scene);

// Converts a state of inside_moving_sides(scene) to the scene's own coordinates. Throws InputError if a side runs into
// a fixed disk until run.t_end.
State moved_back(const Scene& scene, State state);

}  // namespace carom
