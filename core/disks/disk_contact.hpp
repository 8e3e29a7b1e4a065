// Two disks that were in contact in a step.
#pragma once

#include <tuple>

#include "core/base/types.hpp"

namespace carom {

struct DiskContact {
  DiskId id1 = 0, id2 = 0;  // id1 < id2
  double time = 0.0;        // exact: time of the collision; time stepping: end of the step

  bool operator<(const DiskContact& other) const {
    return std::tie(time, id1, id2) < std::tie(other.time, other.id1, other.id2);
  }
  bool operator==(const DiskContact&) const = default;
};

}  // namespace carom
