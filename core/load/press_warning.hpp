// Sides that move so far into the box that the disks cannot all be there, foreseen when a scene is loaded.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line where the sides leave less room before run.t_end than the disks of the start need, else none. Where sinks
// take disks away, nothing is foreseen.
std::vector<std::string> press_warnings(const Scene& scene);

}  // namespace carom
