// Checks of the parts of a scene against each other; each value by itself was checked when it was read.
#pragma once

#include <string>
#include <vector>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Checks lengths of lists, laws that refer to each other, totals and whether this machine can hold them, sides in
// pairs, and the step that a method needs, but not the size of the box. Throws InputError.
void check_parts(const Scene& scene, const PlaceOfKey& place);

// Checks the box against the largest disk, and sources against the box. Preconditions: check_parts passed, box.width
// and box.height are known and positive. Throws InputError. Returns the largest radius that a moving disk can have.
double check_box(const Scene& scene, const PlaceOfKey& place);

// Settings that are not errors, but may be mistakes: keys that the scene's method does not use. One line each.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace carom
