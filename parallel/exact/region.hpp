// A region of the box: the disks of a run of layers, contiguous in memory, whose events one thread processes.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/exact/worker.hpp"

namespace carom {

struct Region {
  Worker worker;
  std::uint32_t middle_tile = 0;           // the first tile of its second half
  std::vector<std::uint32_t> border;       // disks marked at_border
  std::vector<std::uint32_t> near_border;  // disks marked lists_border; some have since come to the border
};

}  // namespace carom
