// Which [[disks]] block of its scene a disk is of, told by its id.
#pragma once

#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// The id after the last of each block, in the order of the scene: ids run on from block to block.
std::vector<DiskId> ends_of_groups(const Scene& scene);

// The number of the block, counted from 0; for a disk from a source, the number after the last block's.
DiskId group_of(const std::vector<DiskId>& ends, DiskId id);

}  // namespace carom
