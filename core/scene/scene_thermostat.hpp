// Reading physics.thermostat, and what it may stand beside.
#pragma once

#include "core/scene/place_of_key.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// The thermostat of [physics], or none. Throws InputError.
Thermostat read_thermostat(const TableReader& physics);

// That there is a time between its kicks, no more than one in a step, that they are not too strong, and that disks have
// velocities. Throws InputError.
void check_thermostat(const Scene& scene, const PlaceOfKey& place);

}  // namespace carom
