// Warnings about inner walls that may not act as the scene expects.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// One line for each inner wall with a segment along a side that has another restitution, is thermal, or rests while the
// wall moves: rounding decides which of the two a disk meets. (Sinks are excepted: they take disks that touch both.)
// One line for each rough wall that moves along itself beneath disks that come to rest on it, since resting contacts
// have no friction.
std::vector<std::string> wall_warnings(const Scene& scene);

}  // namespace carom
