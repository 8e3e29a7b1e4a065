// Reads physics.thermostat, and checks it against the rest of the scene.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The thermostat of [physics], or none. Throws InputError.
Thermostat read_thermostat(const TableReader& physics);

// Throws InputError unless the time between kicks is known, there is at most one kick in a step, kicks are not too
// strong, and velocities are physical.
void check_thermostat(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
