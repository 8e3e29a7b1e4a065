// Warnings about keys that have no effect in a scene with Brownian motion.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line each; none if velocities are not drawn anew each step (core/scene/drawn_velocities.hpp).
std::vector<std::string> brownian_warnings(const Scene& scene);

}  // namespace carom
