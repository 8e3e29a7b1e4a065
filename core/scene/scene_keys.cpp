#include "core/scene/scene_keys.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/scene/keys_of_disks.hpp"
#include "core/scene/keys_of_physics.hpp"
#include "core/scene/keys_of_run.hpp"

namespace carom {

namespace {

// In the order of docs/scene.md.
constexpr auto all_keys() {
  constexpr std::size_t count =
      std::size(keys_of_physics::keys) + std::size(keys_of_disks::keys) + std::size(keys_of_run::keys);
  std::array<SceneKey, count> all{};
  auto next = std::copy(std::begin(keys_of_physics::keys), std::end(keys_of_physics::keys), all.begin());
  next = std::copy(std::begin(keys_of_disks::keys), std::end(keys_of_disks::keys), next);
  std::copy(std::begin(keys_of_run::keys), std::end(keys_of_run::keys), next);
  return all;
}

constexpr auto keys = all_keys();

bool is_index(std::string_view segment) {
  return !segment.empty() && std::all_of(segment.begin(), segment.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::span<const SceneKey> scene_keys() {
  return keys;
}

const SceneKey* find_scene_key(std::string_view table, std::string_view name) {
  const auto* const it = std::find_if(std::begin(keys), std::end(keys),
                                      [&](const SceneKey& k) { return k.table == table && k.name == name; });
  return it == std::end(keys) ? nullptr : it;
}

std::vector<std::string_view> key_names(std::string_view table) {
  std::vector<std::string_view> names;
  for (const SceneKey& key : keys) {
    if (key.table == table) names.push_back(key.name);
  }
  return names;
}

std::string table_of_path(std::string_view path) {
  std::string table;
  while (!path.empty()) {
    const std::size_t dot = path.find('.');
    const std::string_view segment = path.substr(0, dot);
    path.remove_prefix(dot == std::string_view::npos ? path.size() : dot + 1);
    if (is_index(segment)) continue;
    if (!table.empty()) table += '.';
    table += segment;
  }
  return table;
}

}  // namespace carom
