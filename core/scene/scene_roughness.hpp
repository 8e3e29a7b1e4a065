// How rough disks and walls are, and how disks spin at first.
#pragma once

#include <string_view>

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Reads "roughness" of [physics] and "wall_roughness" of [box]; smooth when absent. Throws InputError for anything that
// is not a roughness, and where walls are to be rough but not the disks.
Surfaces read_surfaces(const SceneOrigin& origin);

// The value of "spin" or "spin_temperature" of a group or a source; no spin when both are absent.
SpinLaw read_spins(const TableReader& owner);

// What spins must be for the scene as a whole: there only where disks are rough, as many as disks, and so slow that
// surfaces are no faster than disks may be. Rough disks do not go with Brownian motion.
void check_surfaces(const Scene& scene, const PlaceOfKey& place);

// The same of one group or source, whose disks have this mass and radius at least and at most. path: of its table.
void check_spins(const Scene& scene, const SpinLaw& law, double smallest_mass, double largest_radius,
                 std::string_view path, const PlaceOfKey& place);

}  // namespace carom
