// A warning, when a scene is loaded, about sides that will move in so far that the disks have no room.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line if before run.t_end the sides leave less room than the initial disks need, else none. Always none in scenes
// with sinks.
std::vector<std::string> press_warnings(const Scene& scene);

}  // namespace carom
