// What stands in the box and never moves: disks of infinite mass.
#pragma once

#include "core/base/types.hpp"

namespace carom {

// A fixed disk. It is no entry of Disks: it has no velocity, no weight and no energy.
struct Obstacle {
  double x = 0.0, y = 0.0;   // centre; length
  double radius = 0.0;       // length
  double restitution = 1.0;  // of a disk that collides with it
  DiskId id = 0;             // that it has among the disks of the scene
};

}  // namespace carom
