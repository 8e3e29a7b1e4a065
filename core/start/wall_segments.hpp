// Inner walls of a scene as obstacles.
#pragma once

#include <vector>

#include "core/disks/obstacle.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// The segments of all inner walls, in the order of the scene.
std::vector<Obstacle> segments_of(const Scene& scene);

}  // namespace carom
