// What pairwise loses of disks that are nearly elastic, where gravity makes a pile of them.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line where a step is so long that too much energy may be lost, by a bound that was measured (docs/methods.md);
// none elsewhere. Preconditions: those of scales_of.
std::vector<std::string> settling_warnings(const Scene& scene);

}  // namespace carom
