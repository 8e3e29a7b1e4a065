#include "core/scene/scene_roughness.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/base/input_message.hpp"
#include "core/scene/scene_laws.hpp"
#include "core/scene/scene_range_check.hpp"
#include "core/scene/scene_ranges.hpp"

namespace carom {

namespace {

constexpr double least_inertia = 1e-6;

// The table under `name` of a section of the root, or nullptr.
const toml::table* table_in(const SceneOrigin& origin, std::string_view section, std::string_view name) {
  const toml::node* const owner = origin.root->get(section);
  const toml::node* const node = owner == nullptr || !owner->is_table() ? nullptr : owner->as_table()->get(name);
  if (node == nullptr) return nullptr;
  if (node->is_table()) return node->as_table();
  origin.fail(fmt::format("{}.{}", section, name), fmt::format("is {}", type_name(*node)),
              "expected { tangential_restitution = b, friction = mu }");
}

Roughness read_roughness(const TableReader& reader) {
  Roughness roughness;
  constexpr std::string_view expected = "expected b from -1 (smooth) to 1 (perfectly rough)";
  roughness.friction = reader.number("friction").value_or(HUGE_VAL);
  reader.require("tangential_restitution", expected);
  roughness.restitution = reader.number("tangential_restitution").value();
  if (std::abs(roughness.restitution) > 1.0) {
    reader.fail("tangential_restitution", fmt::format("is {}", roughness.restitution), expected);
  }
  return roughness;
}

}  // namespace

Surfaces read_surfaces(const SceneOrigin& origin) {
  Surfaces surfaces;
  const toml::table* const disks = table_in(origin, "physics", "roughness");
  const toml::table* const walls = table_in(origin, "box", "wall_roughness");
  if (walls != nullptr) surfaces.walls = read_roughness(TableReader(origin, "box.wall_roughness", *walls));
  if (disks == nullptr) {
    if (walls == nullptr) return surfaces;
    origin.fail("box.wall_roughness", "cannot be used without physics.roughness",
                "expected both, or physics.roughness = { tangential_restitution = -1.0 } for disks that are smooth "
                "among themselves");
  }
  const TableReader reader(origin, "physics.roughness", *disks);
  surfaces.disks = read_roughness(reader);
  surfaces.inertia = reader.number_or_initial("inertia");
  if (surfaces.inertia < least_inertia || surfaces.inertia > 1.0) {
    reader.fail("inertia", fmt::format("is {}", surfaces.inertia),
                fmt::format("expected I / (m r^2) from {} to 1 (all mass at the edge)", least_inertia));
  }
  return surfaces;
}

SpinLaw read_spins(const TableReader& owner) {
  SpinLaw law;
  law.temperature = owner.number("spin_temperature").value_or(0.0);
  const toml::node* const node = owner.find("spin");
  if (node == nullptr) return law;
  if (owner.find("spin_temperature") != nullptr) {
    owner.fail("spin_temperature", "cannot be used with spin", "expected one of the two");
  }
  constexpr std::string_view expected = "expected a number, a list of numbers, or { frame = \"DIR\" }";
  if (node->is_table()) {
    law.list = read_spins_of_frame(owner, *node->as_table(), law.file);
  } else if (node->is_array()) {
    law.list = as_numbers(owner.origin(), owner.key("spin"), *node);
  } else if (node->is_number()) {
    law.value = owner.number("spin").value();
  } else {
    owner.fail("spin", fmt::format("is {}", type_name(*node)), expected);
  }
  if (node->is_array() && law.list.empty()) owner.fail("spin", "is an empty list", expected);
  return law;
}

void check_surfaces(const Scene& scene, const PlaceOfKey& place) {
  if (scene.physics.surfaces.are_rough()) {
    if (!(scene.physics.diffusion > 0.0)) return;
    fail_input(place("physics.roughness"), "cannot be used with physics.diffusion: Brownian disks have no velocity",
               "expected one of the two");
  }
  const auto check = [&](const SpinLaw& law, const std::string& path) {
    if (law.value == 0.0 && law.list.empty() && law.temperature == 0.0) return;
    fail_input(place(path + (law.temperature > 0.0 ? ".spin_temperature" : ".spin")),
               "cannot be used without physics.roughness: smooth disks have no spin", "expected both or neither");
  };
  for (std::size_t g = 0; g < scene.groups.size(); ++g) check(scene.groups[g].spins, fmt::format("disks.{}", g));
  for (std::size_t s = 0; s < scene.sources.size(); ++s) check(scene.sources[s].spins, fmt::format("sources.{}", s));
}

void check_spins(const Scene& scene, const SpinLaw& law, double smallest_mass, double largest_radius,
                 std::string_view path, const PlaceOfKey& place) {
  if (!scene.physics.surfaces.are_rough()) return;
  const double most = magnitudes_of(Dimension::speed).most;
  const auto check = [&](double surface_speed, const std::string& key, const std::string& what) {
    if (surface_speed <= most) return;
    fail_input(place(key), fmt::format("is {}, which gives a surface a speed of {}", what, surface_speed),
               expected_range(Dimension::speed));
  };
  check(largest_radius * std::abs(law.value), fmt::format("{}.spin", path), fmt::format("{}", law.value));
  for (std::size_t k = 0; k < law.list.size(); ++k) {
    check(largest_radius * std::abs(law.list[k]), fmt::format("{}.spin.{}", path, k), fmt::format("{}", law.list[k]));
  }
  check(largest_deviate * std::sqrt(law.temperature / (scene.physics.surfaces.inertia * smallest_mass)),
        fmt::format("{}.spin_temperature", path), fmt::format("{}", law.temperature));
}

}  // namespace carom
