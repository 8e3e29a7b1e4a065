// Reads the roughness of disks and walls, and the initial spins.
#pragma once

#include <string_view>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Reads "roughness" of [physics] and "wall_roughness" of [box]; smooth when absent. Throws InputError for anything that
// is not a roughness, and for rough walls without rough disks.
Surfaces read_surfaces(const SceneOrigin& origin);

// The value of "spin" or "spin_temperature" of a group or a source; no spin when both are absent.
SpinLaw read_spins(const TableReader& owner);

// Checks spins against the whole scene: there must be none for smooth disks, as many as disks, and none so fast that
// surfaces exceed the largest speed. Rejects rough disks with Brownian motion.
void check_surfaces(const Scene& scene, const PlaceOfKey& place);

// Checks the spins of one group or source. smallest_mass, largest_radius: of its disks. path: of its table.
void check_spins(const Scene& scene, const SpinLaw& law, double smallest_mass, double largest_radius,
                 std::string_view path, const PlaceOfKey& place);

}  // namespace carom
