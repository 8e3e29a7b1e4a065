// The comparison of two trajectories: where they first differ, and by how much at most.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "core/base/types.hpp"

namespace carom {

// A file without groups has one group. Rounds (image_x, image_y) are compared if both files have them, and if all
// frames of both are compared, since they are counted from the first frame; otherwise only on request.
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
  std::optional<double> tolerance;  // values (and times) must differ by more than this; absent: in any bit
  ComparedFields fields = all_fields();
  double from = -std::numeric_limits<double>::infinity();  // only frames of these times
  double to = std::numeric_limits<double>::infinity();
  std::optional<double> at;  // or only the frame of each file that is nearest to this time
};

// One difference of two trajectories. Frames count from 1.
struct Difference {
  Count frame = 0;    // of A
  double time = 0.0;  // in A
  DiskId id = 0;      // of the disk, if a quantity of a disk differs
  // One of compared_quantities, or time; "disks" or "frames" if one has one that the other lacks; if all fields are
  // compared, also those of the box: "width", "height", "periodic_x", "periodic_y".
  const char* quantity = "";
  double a = 0.0, b = 0.0;  // the two values; for "disks" and "frames" their numbers; 1 for periodic sides
  double by = 0.0;          // |a - b|; for positions to the nearest image, and for rounds consistent with that
};

struct TrajectoryDifference {
  Count frames_a = 0, frames_b = 0;  // number of frames compared
  std::optional<Difference> first;   // none: the files agree by the rule
  // For each quantity, among disks that both frames have: the largest difference, within the tolerance or not.
  std::array<std::optional<Difference>, compared_quantities.size()> largest;
};

// Reads both files, frame by frame. If bits count, 0 and -0 differ. Throws InputError for a damaged file, if a file has
// no frame at the times requested, and if fields are requested by name among which are spins that neither file has, or
// rounds that one does not have.
TrajectoryDifference compare_trajectories(const std::string& a, const std::string& b, const CompareRule& rule = {});

}  // namespace carom
