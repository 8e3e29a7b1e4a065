// Reading the restitution of two disks: a number or a law of their speed, for all of them and for pairs of groups.
#pragma once

#include "core/scene/scene.hpp"
#include "core/scene/scene_reader.hpp"

namespace carom {

// restitution of [physics] and [[physics.pairs]], into scene.physics. Throws InputError for a group that is not there,
// with the nearest name, for a pair that is stated twice, and for a law of the speed beside Brownian motion without
// velocities. Precondition: the rest of [physics], groups and sources have been read.
void read_restitutions(const SceneOrigin& origin, Scene& scene);

}  // namespace carom
