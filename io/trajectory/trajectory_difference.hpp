// Two trajectories side by side: where they first differ, and by how much at most.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "core/base/types.hpp"

namespace carom {

// A file without groups is of one. Rounds (image_x, image_y) are compared in what both files have them for, and all
// frames of each, as they are counted from the first one, or where they are asked for.
inline constexpr std::array<const char*, 10> compared_quantities{"x",    "y",    "vx",    "vy",      "radius",
                                                                 "mass", "spin", "group", "image_x", "image_y"};

using ComparedFields = std::array<bool, compared_quantities.size()>;

constexpr ComparedFields all_fields() {
  ComparedFields all{};
  all.fill(true);
  return all;
}

// What counts as a difference.
struct CompareRule {
  std::optional<double> tolerance;  // values (and times) differ by more than this; absent: in any bit
  ComparedFields fields = all_fields();
  double from = -std::numeric_limits<double>::infinity();  // frames of these times only
  double to = std::numeric_limits<double>::infinity();
  std::optional<double> at;  // or only the frame of each that is nearest to this time
};

// One place where two trajectories differ. Frames count from 1.
struct Difference {
  Count frame = 0;    // of A
  double time = 0.0;  // in A
  DiskId id = 0;      // if a quantity of a disk differs
  // One of compared_quantities, or time; "disks" or "frames" if one has what the other lacks; of the box, where all
  // fields are compared, "width", "height", "periodic_x", "periodic_y".
  const char* quantity = "";
  double a = 0.0, b = 0.0;  // the two values; for "disks" and "frames" their numbers; 1 of periodic sides
  double by = 0.0;          // |a - b|; of places to the nearest image, and of rounds between these
};

struct TrajectoryDifference {
  Count frames_a = 0, frames_b = 0;  // those compared
  std::optional<Difference> first;   // none: the same, by the rule
  // For each quantity, among disks that both frames have: the largest difference, within the tolerance or not.
  std::array<std::optional<Difference>, compared_quantities.size()> largest;
};

// Reads both files, frame by frame. Where bits count, 0 and -0 differ. Throws InputError for a damaged file, where a
// file has no frame of the times asked for, and where some fields are asked for, and spins among them that neither has,
// or rounds that one has not.
TrajectoryDifference compare_trajectories(const std::string& a, const std::string& b, const CompareRule& rule = {});

}  // namespace carom
