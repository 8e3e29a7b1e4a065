// The deepest overlap, all pairs and all images, with no grid: what engines and their measures share is not
// asked.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/obstacle.hpp"
#include "core/scene/scene.hpp"

namespace carom::fuzz {

struct Closest {
  double gap = HUGE_VAL;  // over the smallest radius; below 0 where there is an overlap
  std::string what;       // "disks 3 and 7 overlap"
};

// Sinks are looked at like walls: they have taken what touched them.
Closest closest_of(const Disks& disks, const std::vector<Obstacle>& obstacles, const Scene& scene, double time);

}  // namespace carom::fuzz
