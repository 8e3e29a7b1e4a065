// Two trajectories side by side: where they first differ, and by how much at most.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/types.hpp"

namespace carom {

inline constexpr std::array<const char*, 6> compared_quantities{"x", "y", "vx", "vy", "radius", "mass"};

// One place where two trajectories differ. Frames count from 1.
struct Difference {
  Count frame = 0;
  double time = 0.0;          // in A
  DiskId id = 0;              // if a quantity of a disk differs
  const char* quantity = "";  // x, y, vx, vy, radius, mass, time; "disks" or "frames" if one has what the other lacks
  double a = 0.0, b = 0.0;    // the two values; for "disks" and "frames" their numbers
};

struct TrajectoryDifference {
  Count frames_a = 0, frames_b = 0;
  std::optional<Difference> first;                   // none: the same bits
  std::array<std::optional<Difference>, 6> largest;  // for each quantity, among disks that both frames have
};

// Reads both files, frame by frame. Bits are compared, so 0 and -0 differ. Throws InputError for a damaged file.
TrajectoryDifference compare_trajectories(const std::string& a, const std::string& b);

}  // namespace carom
