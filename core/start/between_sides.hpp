// How a scene starts whose sides move: in the room between them.
#pragma once

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The scene in a box that ends where its moving sides stand at time 0, none of which moves; coordinates are that box's.
// Throws InputError where a region reaches beyond a side.
Scene inside_moving_sides(const Scene& scene);

// The state of inside_moving_sides(scene) in the scene's own coordinates. Throws InputError where a side runs into a
// fixed disk until run.t_end.
State moved_back(const Scene& scene, State state);

}  // namespace carom
