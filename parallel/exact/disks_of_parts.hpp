// The disks of each part of the box.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/exact/box_cut.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The indices of the disks that a part owns or has in its halo, ascending; and how many it owns.
struct DisksOfPart {
  std::vector<std::uint32_t> index;
  std::size_t own = 0;
};

// The disks of each part of the cut; the same for any number of threads.
std::vector<DisksOfPart> disks_of_parts(const Disks& disks, const BoxCut& cut, const Executor& executor);

}  // namespace carom
