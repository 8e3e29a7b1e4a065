// What must hold between the parts of a scene; each value by itself was checked when it was read.
#pragma once

#include <string>
#include <vector>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Lengths of lists, laws that refer to each other, totals and whether this machine can hold them, sides in pairs, the
// step that a method needs. The size of the box is not looked at. Throws InputError.
void check_parts(const Scene& scene, const PlaceOfKey& place);

// The box against the largest disk, and sources against the box. Precondition: check_parts passed, box.width and
// box.height are known and positive. Throws InputError. Returns the largest radius that a disk which moves can have.
double check_box(const Scene& scene, const PlaceOfKey& place);

// What is no error, but may not be what was meant: keys that the scene's method does not use. One line each.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace carom
