#include "core/scene/disk_group.hpp"

#include <algorithm>

namespace carom {

std::vector<DiskId> ends_of_groups(const Scene& scene) {
  std::vector<DiskId> ends;
  Count end = 0;
  for (const DiskGroup& group : scene.groups) ends.push_back(static_cast<DiskId>(end += group.count));
  return ends;
}

DiskId group_of(const std::vector<DiskId>& ends, DiskId id) {
  return static_cast<DiskId>(std::upper_bound(ends.begin(), ends.end(), id) - ends.begin());
}

}  // namespace carom
