// What a scene with Brownian motion asks for and cannot have.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line each, none where velocities are no drawn displacements (core/scene/drawn_velocities.hpp).
std::vector<std::string> brownian_warnings(const Scene& scene);

}  // namespace carom
