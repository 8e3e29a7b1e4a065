// Checks of the box against the disks, sources and walls in it, once its size is known.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Checks the box against the largest disk, and sources against the box. Preconditions: check_parts passed, box.width
// and box.height are known and positive. Throws InputError. Returns the largest radius that a moving disk can have.
double check_box(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
