// Which disks collided, to compare two methods collision by collision. Only the references keep one.
#pragma once

#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace carom {

// One entry a disk-disk collision, smaller id first, in the order in which they were resolved. Walls are left out.
using CollisionLog = std::vector<std::pair<DiskId, DiskId>>;

}  // namespace carom
