#include "app/sweep/scene_of_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>

#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene_text.hpp"
#include "io/checkpoint/checkpoint_place.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// The files, by their names in the scene, that gave its disks other values then than now.
std::set<std::string> changed_files(const Scene& then, const Scene& now) {
  std::set<std::string> names;
  const auto see = [&](const std::string& file, bool same) {
    if (!file.empty() && !same) names.insert(file);
  };
  for (std::size_t g = 0; g < std::min(then.groups.size(), now.groups.size()); ++g) {
    const DiskGroup& before = then.groups[g];
    const DiskGroup& group = now.groups[g];
    see(group.positions.file, before.positions.list == group.positions.list);
    see(group.velocities.file, before.velocities.list == group.velocities.list);
    see(group.spins.file, before.spins.list == group.spins.list);
    see(group.radius.file, before.radius.values == group.radius.values);
    see(group.mass.file, before.mass.values == group.mass.values);
  }
  return names;
}

}  // namespace

std::size_t fingerprint(const std::string& scene_text) {
  return std::hash<std::string>{}(scene_text);
}

std::string scene_of_run(const fs::path& folder) {
  if (fs::exists(folder / "summary.json")) {
    const std::string file = (folder / "scene.toml").string();
    return read_text_file(file, file);
  }
  try {
    return read_checkpoint_at(find_checkpoint(folder.string())).record.scene_text;
  } catch (const InputError&) {
    return "";
  }
}

bool is_of_fingerprint(const std::string& scene_text, std::size_t print) {
  return fingerprint(scene_text) == print ||
         fingerprint(resolved_toml(parse_scene(scene_text, "scene.toml", ""))) == print;
}

std::string change_since(const std::string& scene_text, const Scene& now, const std::string& run) {
  const std::set<std::string> files = changed_files(parse_scene(scene_text, "scene.toml", ""), now);
  if (files.empty()) return fmt::format("its run {} has another scene", run);
  return fmt::format("{} {} changed since run {} began", fmt::join(files, " and "), files.size() == 1 ? "has" : "have",
                     run);
}

}  // namespace carom
