// Warnings about a scene that can be given before it runs.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// Settings that are not errors, but may be mistakes: keys that the scene's method does not use. One line each.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace carom
