// Inner walls that will not do all that a scene may expect of them.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line for each inner wall of which a segment lies along a wall side that has another restitution, is thermal, or
// stands still where the wall moves: of the two a disk meets either one, as rounding has it. No sinks: they take what
// touches both. One for each rough wall that moves along itself beneath disks that come to rest on it, where those bear
// load without friction.
std::vector<std::string> wall_warnings(const Scene& scene);

}  // namespace carom
