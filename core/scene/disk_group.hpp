// Which [[disks]] block of its scene a disk is of, told by its id.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// The id after the last of each block, in the order of the scene: ids run on from block to block.
std::vector<DiskId> ends_of_groups(const Scene& scene);

// The number of the block, counted from 0; for a disk from a source, the number after the last block's.
DiskId group_of(const std::vector<DiskId>& ends, DiskId id);

// The same without the ends, for one disk.
DiskId group_of(const Scene& scene, DiskId id);

// Are there disks of several blocks, or of one and from sources? Where not, the group of a disk says nothing.
bool has_several_groups(const Scene& scene);

// What the disks of all sources together are called.
inline constexpr std::string_view sources_name = "sources";

// Disks that have a name.
struct NamedGroup {
  std::string name;
  DiskId number = 0;  // as group_of says
  IdRange ids;
};

// The blocks with a name, in the order of the scene, and "sources" where the scene has any. Not those of fixed disks,
// which have no motion and are measured nowhere.
std::vector<NamedGroup> named_groups(const Scene& scene);

// What the scene calls the group with this number, as group_of says; empty: it has no name.
std::string_view name_of_group(const Scene& scene, DiskId number);

// The same, but none where no block has a name: what a run tells of each group.
std::vector<NamedGroup> reported_groups(const Scene& scene);

}  // namespace carom
