#include "core/scene/scene_restitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/input_message.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/drawn_velocities.hpp"

namespace carom {

namespace {

constexpr std::string_view expected_pairs =
    "expected a table [[physics.pairs]] with groups = [\"a\", \"b\"] and restitution";

// The number of the group with this name, fixed ones included.
DiskId number_of_group(const SceneOrigin& origin, const std::string& key, const std::string& name, const Scene& scene) {
  std::vector<std::string_view> names;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    if (scene.groups[g].name.empty()) continue;
    if (scene.groups[g].name == name) return static_cast<DiskId>(g);
    names.push_back(scene.groups[g].name);
  }
  if (!scene.sources.empty()) {
    if (name == sources_name) return static_cast<DiskId>(scene.groups.size());
    names.push_back(sources_name);
  }
  const std::string what = fmt::format("unknown group {}", in_quotes(name));
  if (names.empty()) origin.fail(key, what, "expected the name of a [[disks]] block, and none has one");
  origin.fail(key, what, expected_one_of(names, name));
}

bool is_fixed(const Scene& scene, DiskId number) {
  return number < scene.groups.size() && scene.groups[number].fixed;
}

// The value of "restitution"; 1 when absent.
Restitution read_restitution(const TableReader& owner, const Scene& scene) {
  const toml::node* node = owner.find("restitution");
  if (node == nullptr) return {};
  const toml::table* table = node->as_table();
  if (table == nullptr) return {owner.number("restitution").value(), 0.0};
  if (velocities_are_drawn(scene)) {
    owner.fail("restitution", "depends on the speed, and Brownian disks have none", "expected a number from 0 to 1");
  }
  const TableReader reader(owner.origin(), owner.key("restitution"), *table, "physics.restitution");
  Restitution law;
  law.least = reader.number_or_initial("least");
  if (law.least == 1.0) {
    reader.fail("least", "is 1, so that no collision loses energy", "expected a number below 1, or restitution = 1");
  }
  reader.require("viscoelastic", "expected the number a in e(v) = max(least, 1 - a v^(1/5))");
  law.viscosity = reader.number("viscoelastic").value();
  return law;
}

GroupPair read_pair(const TableReader& reader, const Scene& scene) {
  constexpr std::string_view expected = "expected the names of two groups, as in [\"light\", \"heavy\"]";
  const SceneOrigin& origin = reader.origin();
  const std::string key = reader.key("groups");
  const toml::array& names = as_list(origin, key, reader.require("groups", expected), expected);
  if (names.size() != 2) reader.fail("groups", fmt::format("is a list of {}", names.size()), expected);
  DiskId number[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string entry = fmt::format("{}.{}", key, k);
    number[k] = number_of_group(origin, entry, as_text(origin, entry, names[k]), scene);
  }
  if (is_fixed(scene, number[0]) && is_fixed(scene, number[1])) {
    reader.fail("groups", "are both of fixed disks, which never collide", "expected one of them to move");
  }
  reader.require("restitution", "expected a number from 0 to 1, or { viscoelastic = a }");
  return {std::min(number[0], number[1]), std::max(number[0], number[1]), read_restitution(reader, scene)};
}

void read_pairs(const TableReader& physics, Scene& scene) {
  const toml::node* node = physics.find("pairs");
  if (node == nullptr) return;
  const SceneOrigin& origin = physics.origin();
  const std::string key = physics.key("pairs");
  const toml::array& list = as_list(origin, key, *node, expected_pairs);
  RestitutionLaw& law = scene.physics.law;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::string path = fmt::format("{}.{}", key, k);
    const toml::table* table = list[k].as_table();
    if (table == nullptr) origin.fail(path, fmt::format("is {}", type_name(list[k])), expected_pairs);
    const TableReader reader(origin, path, *table);
    const GroupPair pair = read_pair(reader, scene);
    const auto place = std::lower_bound(law.pairs.begin(), law.pairs.end(), pair);
    if (place != law.pairs.end() && !(pair < *place)) {
      reader.fail("groups",
                  fmt::format("are {} and {}, a pair that is already given", name_of_group(scene, pair.first),
                              name_of_group(scene, pair.second)),
                  "expected each pair once, in either order");
    }
    law.pairs.insert(place, pair);
  }
  if (!law.pairs.empty()) law.ends = ends_of_groups(scene);
}

}  // namespace

void read_restitutions(const SceneOrigin& origin, Scene& scene) {
  const toml::node* const node = origin.root->get("physics");
  if (node == nullptr) return;
  const TableReader physics(origin, "physics", *node->as_table());
  const Restitution common = read_restitution(physics, scene);
  scene.physics.restitution = common.least;
  scene.physics.law.viscosity = common.viscosity;
  read_pairs(physics, scene);
}

}  // namespace carom
