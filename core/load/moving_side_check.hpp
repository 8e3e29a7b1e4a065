// Checks, when a scene is loaded, that moving sides will run into nothing.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Throws InputError if until run.t_end a side runs into an inner wall, or sweeps over the region of a source.
// Precondition: settle_sides passed. Fixed disks are checked when they have their places (initial_state).
void check_sweeps(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
