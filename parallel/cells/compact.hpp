// Removes marked disks from the columns, in parallel; the others close up and keep their order.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// remove_marked of core/disks/disks.hpp with the same result. gone has n entries; column and ids are scratch.
void remove_in_parallel(Disks& disks, const std::vector<unsigned char>& gone, const Executor& executor,
                        std::vector<double>& column, std::vector<DiskId>& ids);

}  // namespace carom
