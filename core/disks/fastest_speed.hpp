// The speed of the fastest disk.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/disks/disks.hpp"

namespace carom {

// sqrt(vx^2 + vy^2) of the fastest disk, length / time; 0 without disks.
inline double fastest_speed(const Disks& disks) {
  double fastest2 = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    fastest2 = std::max(fastest2, disks.vx[i] * disks.vx[i] + disks.vy[i] * disks.vy[i]);
  }
  return std::sqrt(fastest2);
}

}  // namespace carom
