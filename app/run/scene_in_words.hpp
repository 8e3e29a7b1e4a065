// The sides of a scene's box and its physics in words, for carom check: one line each, without the newline.
#pragma once

#include <string>

#include "core/scene/scene.hpp"

namespace carom {

// "left wall, right wall, bottom sink, top wall; 2 inner walls".
std::string sides_text(const Scene& scene);

// "gravity 10 downwards; restitution 0.5 of disks, 1 at walls".
std::string physics_text(const Scene& scene);

}  // namespace carom
