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

DiskId group_of(const Scene& scene, DiskId id) {
  Count end = 0;
  std::size_t g = 0;
  while (g < scene.groups.size() && (end += scene.groups[g].count) <= id) ++g;
  return static_cast<DiskId>(g);
}

bool has_several_groups(const Scene& scene) {
  return scene.groups.size() + (scene.sources.empty() ? 0 : 1) > 1;
}

std::vector<NamedGroup> named_groups(const Scene& scene) {
  std::vector<NamedGroup> named;
  const std::vector<DiskId> ends = ends_of_groups(scene);
  DiskId first = 0;
  for (std::size_t g = 0; g < ends.size(); first = ends[g++]) {
    if (scene.groups[g].name.empty() || scene.groups[g].fixed) continue;
    named.push_back({scene.groups[g].name, static_cast<DiskId>(g), {first, ends[g]}});
  }
  if (!scene.sources.empty()) {
    IdRange later;
    later.first = first;
    named.push_back({std::string(sources_name), static_cast<DiskId>(ends.size()), later});
  }
  return named;
}

std::string_view name_of_group(const Scene& scene, DiskId number) {
  return number < scene.groups.size() ? std::string_view(scene.groups[number].name) : sources_name;
}

std::vector<NamedGroup> reported_groups(const Scene& scene) {
  const auto has_name = [](const DiskGroup& group) { return !group.name.empty() && !group.fixed; };
  if (std::none_of(scene.groups.begin(), scene.groups.end(), has_name)) return {};
  return named_groups(scene);
}

}  // namespace carom
