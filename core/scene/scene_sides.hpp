// Reading what the four sides of the box do, the keys left to top of [box].
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Each is a name, or a table that says more of a wall; with them the rate of a shear. Throws InputError.
void read_sides(const TableReader& box, Scene& scene);

// What is left of a shear, and where moving sides begin, once box and t_end are known, and whether they stay in the box
// and leave room for a disk of the largest radius. Throws InputError.
void settle_sides(Scene& scene, double largest_radius, const PlaceOfKey& place);

}  // namespace carom
