// Disks that are contiguous in memory, those of a run of layers; one thread processes their events.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/exact/worker.hpp"

namespace carom {

struct Region {
  Worker worker;
  std::uint32_t middle_tile = 0;           // the first one on the far side of its middle
  std::vector<std::uint32_t> border;       // disks marked at_border
  std::vector<std::uint32_t> near_border;  // disks marked lists_border; some have come to be at the border since
};

}  // namespace carom
