// Two trajectories side by side: where they first differ, and by how much at most.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "core/base/types.hpp"

namespace carom {

inline constexpr std::array<const char*, 7> compared_quantities{"x", "y", "vx", "vy", "radius", "mass", "spin"};

// What counts as a difference.
struct CompareRule {
  std::optional<double> tolerance;  // values (and times) differ by more than this; absent: in any bit
  std::array<bool, compared_quantities.size()> fields{true, true, true, true, true, true, true};
  double from = -std::numeric_limits<double>::infinity();  // frames of these times only
  double to = std::numeric_limits<double>::infinity();
  std::optional<double> at;  // or only the frame of each that is nearest to this time
};

// One place where two trajectories differ. Frames count from 1.
struct Difference {
  Count frame = 0;    // of A
  double time = 0.0;  // in A
  DiskId id = 0;      // if a quantity of a disk differs
  // x, y, vx, vy, radius, mass, spin, time; "disks" or "frames" if one has what the other lacks; of the box, where all
  // fields are compared, "width", "height", "periodic_x", "periodic_y".
  const char* quantity = "";
  double a = 0.0, b = 0.0;  // the two values; for "disks" and "frames" their numbers; 1 of periodic sides
  double by = 0.0;          // |a - b|; of places to the nearest image
};

struct TrajectoryDifference {
  Count frames_a = 0, frames_b = 0;  // those compared
  std::optional<Difference> first;   // none: the same, by the rule
  // For each quantity, among disks that both frames have: the largest difference, within the tolerance or not.
  std::array<std::optional<Difference>, compared_quantities.size()> largest;
};

// Reads both files, frame by frame. Where bits count, 0 and -0 differ. Throws InputError for a damaged file, where a
// file has no frame of the times asked for, and where some fields are asked for, spin among them, that neither has.
TrajectoryDifference compare_trajectories(const std::string& a, const std::string& b, const CompareRule& rule = {});

}  // namespace carom
