// The velocity autocorrelation.
#pragma once

#include <vector>

#include "core/disks/disks_in_pieces.hpp"

namespace carom {

// Velocities of the first sample, by id; NaN: no such disk.
struct VelocityMemory {
  bool begun = false;
  std::vector<double> vx, vy;
};

void begin_memory(VelocityMemory& memory, const DisksInPieces& disks);
inline void begin_memory(VelocityMemory& memory, const Disks& disks) {
  begin_memory(memory, WholeDisks(disks, 0.0));
}

// Mean of v(0) v(t) over the disks of the first sample that are still there; length^2 / time^2, NaN without any. In
// order of ids: the same bits in any storage order.
double velocity_autocorrelation(const VelocityMemory& memory, const DisksInPieces& disks);
inline double velocity_autocorrelation(const VelocityMemory& memory, const Disks& disks) {
  return velocity_autocorrelation(memory, WholeDisks(disks, 0.0));
}

}  // namespace carom
