// Checks of the parts of a scene against each other; each value by itself was checked when it was read.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Checks lengths of lists, laws that refer to each other, totals and whether this machine can hold them, sides in
// pairs, and the step that a method needs, but not the size of the box. Throws InputError.
void check_parts(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
