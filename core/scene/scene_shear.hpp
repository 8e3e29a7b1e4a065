// Reads box.shear_rate, and checks that the rest of the scene allows it.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The rate; 1 / time, 0 without the key. Throws InputError.
double read_shear_rate(const TableReader& box);

// To be called once the whole scene is read: rejects what cannot be combined with a shear, sets the velocity of the
// images above, and checks its range and the size of the box. largest_radius: of the disks. Throws InputError.
void settle_shear(Scene& scene, double largest_radius, const PlaceOfKey& place);

}  // namespace carom
