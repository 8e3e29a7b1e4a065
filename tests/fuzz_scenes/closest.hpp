// The deepest overlap over all pairs and all images, without a grid, so that it does not depend on code that engines
// and their measures share.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/obstacle.hpp"
#include "core/scene/scene.hpp"

namespace carom::fuzz {

struct Closest {
  double gap = HUGE_VAL;  // over the smallest radius; negative for an overlap
  std::string what;       // "disks 3 and 7 overlap"
};

// Sinks are treated like walls, as they have taken all disks that touched them.
Closest closest_of(const Disks& disks, const std::vector<Obstacle>& obstacles, const Scene& scene, double time);

}  // namespace carom::fuzz
