// Inner walls that lie along a side of the box and are to do something else than that.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line for each inner wall of which a segment lies along a wall side that has another restitution, is thermal, or
// stands still where the wall moves: of the two a disk meets either one, as rounding has it. No sinks: they take what
// touches both.
std::vector<std::string> wall_warnings(const Scene& scene);

}  // namespace carom
