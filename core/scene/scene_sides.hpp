// Reads the four sides of the box, the keys left, right, bottom and top of [box].
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Each is a name, or a table with the properties of a wall. Also reads the rate of a shear. Throws InputError.
void read_sides(const TableReader& box, Scene& scene);

// To be called once box and t_end are known: settles the shear and the initial places of moving sides. Throws
// InputError unless the sides stay in the box and leave room for a disk of the largest radius.
void settle_sides(Scene& scene, double largest_radius, const PlaceOfKey& place);

}  // namespace carom
