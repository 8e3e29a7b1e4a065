// A warning about the energy that pairwise loses too much in a pile of nearly elastic disks.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line if the step is so long that too much energy may be lost, by a measured bound (docs/methods.md); else none.
// Preconditions: those of scales_of.
std::vector<std::string> settling_warnings(const Scene& scene);

}  // namespace carom
