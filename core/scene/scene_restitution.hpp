// Reads the restitution of two disks: a number or a law of their speed, for all disks and for pairs of groups.
#pragma once

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// Reads restitution of [physics] and [[physics.pairs]] into scene.physics. Throws InputError for an unknown group, with
// the nearest name, for a pair that is given twice, and for a law of the speed if velocities are not physical
// (velocities_are_drawn). Precondition: the rest of [physics], groups and sources have been read.
void read_restitutions(const SceneOrigin& origin, Scene& scene);

}  // namespace carom
