// The groups of a scene, its [[disks]] blocks, and the group of a disk by its id.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace carom {

// For each block, the id after its last disk, in the order of the scene: ids are consecutive from block to block.
std::vector<DiskId> ends_of_groups(const Scene& scene);

// The number of a disk's block, counted from 0; for a disk from a source, the number of blocks.
DiskId group_of(const std::vector<DiskId>& ends, DiskId id);

// The same without the ends, for one disk.
DiskId group_of(const Scene& scene, DiskId id);

// Are there disks of more than one group, those from sources counting as one?
bool has_several_groups(const Scene& scene);

// The name of the disks from all sources.
inline constexpr std::string_view sources_name = "sources";

// A group that has a name.
struct NamedGroup {
  std::string name;
  DiskId number = 0;  // as by group_of
  IdRange ids;
};

// The blocks with a name, in the order of the scene, and "sources" if the scene has any. Without blocks of fixed disks,
// which are not measured.
std::vector<NamedGroup> named_groups(const Scene& scene);

// The name of the group with this number (group_of); empty if it has none.
std::string_view name_of_group(const Scene& scene, DiskId number);

// The groups that a run reports: named_groups, but none if no block has a name.
std::vector<NamedGroup> reported_groups(const Scene& scene);

}  // namespace carom
