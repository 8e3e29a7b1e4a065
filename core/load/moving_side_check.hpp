// What sides that move would run into, foreseen when a scene is loaded.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Inner walls that a side runs into until run.t_end, and regions of sources that one sweeps over. Precondition:
// settle_sides passed. Throws InputError. Fixed disks are checked when they have their places (initial_state).
void check_sweeps(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
