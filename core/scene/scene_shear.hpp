// Reading box.shear_rate, and what it may stand beside.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The rate; 1 / time, 0 without the key. Throws InputError.
double read_shear_rate(const TableReader& box);

// The rest, once all of the scene is read: that a scene with a shear has nothing that the shear does not go with, the
// velocity of the images above, and that it and the box are of a size that can be computed with. largest_radius: of the
// disks. Throws InputError.
void settle_shear(Scene& scene, double largest_radius, const PlaceOfKey& place);

}  // namespace carom
