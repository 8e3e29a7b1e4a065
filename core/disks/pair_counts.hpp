// Pairs of disks by their distance, at one moment.
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace carom {

struct PairCounts {
  Count centres = 0;          // disks whose surroundings were counted
  std::vector<Count> counts;  // ordered pairs from them, by bin
};

}  // namespace carom
