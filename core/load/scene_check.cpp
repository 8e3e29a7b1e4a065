#include "core/load/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_message.hpp"
#include "core/base/machine_memory.hpp"
#include "core/base/short_number.hpp"
#include "core/load/memory_need.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_range_check.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/scene_roughness.hpp"
#include "core/scene/scene_thermostat.hpp"

namespace carom {

namespace {

void check_length(std::size_t length, Count count, const std::string& where) {
  if (length == count) return;
  fail_input(where, fmt::format("has {} for count = {}", counted(length, "entry"), count),
             "expected one entry for each disk");
}

// where: of the group with which there are too many disks.
void check_memory(const Scene& scene, Method method, Count total, const std::string& where) {
  constexpr double gigabyte = 1e9;
  const double need = least_memory(method, total, scene.physics.surfaces.are_rough());
  const double have = machine_memory();
  if (need <= have) return;
  fail_input(where,
             fmt::format("{} disks need at least {:.3g} GB of memory with method {}, and this machine has {:.3g} GB",
                         total, need / gigabyte, name_of(method), have / gigabyte),
             "expected fewer disks");
}

void check_sizes_differ(const SizeLaw& radius, const SizeLaw& mass, const std::string& where) {
  if (radius.kind != SizeLaw::Kind::from_other || mass.kind != SizeLaw::Kind::from_other) return;
  fail_input(where, "radius and mass are both derived from each other",
             "expected one of them without from_mass or from_radius");
}

void check_group(const DiskGroup& group, const std::string& path, const PlaceOfKey& place) {
  const auto at = [&](std::string_view name) { return place(fmt::format("{}.{}", path, name)); };
  check_sizes_differ(group.radius, group.mass, at("radius"));
  check_positions(group.positions, path, place);
  if (group.positions.kind == PositionLaw::Kind::list) {
    check_length(group.positions.list.size(), group.count, at("positions"));
  }
  const PositionLaw::Kind kind = group.positions.kind;
  if (group.positions.region && (kind == PositionLaw::Kind::list || kind == PositionLaw::Kind::growth)) {
    fail_input(at("region"),
               kind == PositionLaw::Kind::list ? "cannot be used with a list of positions"
                                               : "cannot be used with positions = \"growth\"",
               "expected positions = \"random\", \"square\" or \"hexagonal\"");
  }
  if (group.velocities.kind == VelocityLaw::Kind::list) {
    check_length(group.velocities.list.size(), group.count, at("velocities"));
  }
  if (!group.spins.list.empty() || !group.spins.file.empty()) {  // a frame may have no disks
    check_length(group.spins.list.size(), group.count, at("spin"));
  }
  if (group.radius.kind == SizeLaw::Kind::list) check_length(group.radius.values.size(), group.count, at("radius"));
  if (group.mass.kind == SizeLaw::Kind::list) check_length(group.mass.values.size(), group.count, at("mass"));
  if (group.velocities.kind == VelocityLaw::Kind::maxwell && group.velocities.temperature > 0.0 && group.count == 1) {
    fail_input(at("velocities"), "maxwell cannot be used with a single disk: minus the mean, its velocity is 0",
               "expected two disks or more, or a list with one velocity");
  }
}

void check_source(const Source& source, const Domain& box, const std::string& path, const PlaceOfKey& place) {
  const auto at = [&](std::string_view name) { return place(fmt::format("{}.{}", path, name)); };
  check_sizes_differ(source.radius, source.mass, at("radius"));
  if (!source.spins.list.empty()) fail_input(at("spin"), "is a list", "expected a number");
  if (source.side && box.side(*source.side) == SideKind::periodic) {
    fail_input(at("side"), fmt::format("{} is periodic", side_names[static_cast<std::size_t>(*source.side)]),
               "expected a wall or sink side");
  }
}

// A Brownian disk that starts at a sink crosses it within its first interval, almost certainly.
void check_source_at_sink(const Scene& scene, const Source& source, const std::string& where) {
  const bool sink = source.side && scene.box.side(*source.side) == SideKind::sink;
  if (!sink || !(scene.physics.diffusion > 0.0) || scene.physics.accumulate) return;
  fail_input(where,
             fmt::format("{} is a sink, which would remove Brownian disks that start there at once",
                         side_names[static_cast<std::size_t>(*source.side)]),
             "expected a wall side, or a region away from the sink");
}

void check_sides(const Domain& box, const PlaceOfKey& place) {
  for (const auto& [a, b] : {std::pair(Side::left, Side::right), std::pair(Side::bottom, Side::top)}) {
    const bool first = box.side(a) == SideKind::periodic;
    if (first == (box.side(b) == SideKind::periodic)) continue;
    const std::string_view with = side_names[static_cast<std::size_t>(first ? a : b)];
    const std::string_view without = side_names[static_cast<std::size_t>(first ? b : a)];
    fail_input(place(fmt::format("box.{}", with)), fmt::format("{} is periodic but {} is not", with, without),
               "expected periodic sides in opposite pairs");
  }
}

// Refuses what cannot be combined with moving walls.
void check_moving_walls(const Scene& scene, const PlaceOfKey& place) {
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    if (!scene.walls[k].motion.moves() || !(scene.physics.diffusion > 0.0)) continue;
    fail_input(place(fmt::format("walls.{}.motion", k)),
               "cannot be used with physics.diffusion: Brownian disks have no velocity", "expected one of the two");
  }
  for (const Side side : all_sides) {
    if (!scene.box.moves(side)) continue;
    const std::string where = place(fmt::format("box.{}.motion", side_names[static_cast<std::size_t>(side)]));
    if (scene.physics.diffusion > 0.0) {
      fail_input(where, "cannot be used with physics.diffusion: Brownian disks have no velocity",
                 "expected one of the two");
    }
  }
}

// Brownian disks have no velocity that a thermal side could give them.
void check_thermal_motion(const Scene& scene, const PlaceOfKey& place) {
  if (!(scene.physics.diffusion > 0.0)) return;
  for (const Side side : all_sides) {
    if (!scene.box.is_thermal(side)) continue;
    fail_input(place(fmt::format("box.{}.temperature", side_names[static_cast<std::size_t>(side)])),
               "cannot be used with physics.diffusion: velocities of Brownian disks are drawn anew in each step",
               "expected one of the two");
  }
}

void check_run(const Scene& scene, const PlaceOfKey& place) {
  if (scene.run.automatic) return;  // its dt is still to be chosen
  const bool time_stepping = scene.run.method != Method::exact;
  if (scene.run.dt > 0.0 || (!time_stepping && scene.physics.diffusion == 0.0)) return;
  fail_input(place("run.dt"), "missing",
             time_stepping ? "expected the time step of methods rollback and pairwise"
                           : "expected the time step of Brownian motion (diffusion > 0)");
}

void check_names(const Scene& scene, const PlaceOfKey& place) {
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    for (std::size_t before = 0; before < g; ++before) {
      if (scene.groups[g].name.empty() || scene.groups[g].name != scene.groups[before].name) continue;
      fail_input(place(fmt::format("disks.{}.name", g)),
                 fmt::format("is \"{}\", the name of disks.{}", scene.groups[g].name, before),
                 "expected a name that no other group has");
    }
  }
}

// Growing disks keep clear of fixed ones, which have their places already, but would not of disks placed otherwise.
void check_growth(const Scene& scene, const PlaceOfKey& place) {
  const auto group_with = [&](bool growth) {
    std::size_t g = 0;
    const auto is_it = [&](const DiskGroup& d) {
      return !d.fixed && (d.positions.kind == PositionLaw::Kind::growth) == growth;
    };
    while (g < scene.groups.size() && !is_it(scene.groups[g])) ++g;
    return g;
  };
  if (scene.growth.given && group_with(true) == scene.groups.size()) {
    fail_input(place("growth"), "no group grows", "expected positions = \"growth\" in [[disks]] as well");
  }
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    if (!scene.groups[g].fixed || scene.groups[g].positions.kind != PositionLaw::Kind::growth) continue;
    fail_input(place(fmt::format("disks.{}.positions", g)), "is \"growth\" for fixed disks, which do not grow",
               "expected other positions");
  }
  const std::size_t other = group_with(false);
  if (group_with(true) == scene.groups.size() || other == scene.groups.size()) return;
  fail_input(
      place(fmt::format("disks.{}.positions", other)),
      fmt::format(
          "cannot be used with \"growth\" of disks.{}: all disks of a scene except fixed ones grow together, or none",
          group_with(true)),
      "expected \"growth\" for every group, or for none");
}

}  // namespace

void check_parts(const Scene& scene, const PlaceOfKey& place) {
  check_sides(scene.box, place);
  check_thermal_motion(scene, place);
  check_moving_walls(scene, place);
  Count total = 0;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    const std::string path = fmt::format("disks.{}", g);
    const Count count = scene.groups[g].count;
    if (count > most_disks || total + count > most_disks) {
      fail_input(place(path + ".count"), fmt::format("{} disks are too many", std::max(count, total + count)),
                 fmt::format("expected at most {} in all", most_disks));
    }
    total += count;
    const bool flies = scene.groups[g].positions.kind == PositionLaw::Kind::growth;  // by exact, in any scene
    check_memory(scene, flies ? Method::exact : scene.run.method, total, place(path + ".count"));
    check_group(scene.groups[g], path, place);
  }
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    check_source(scene.sources[k], scene.box, fmt::format("sources.{}", k), place);
    check_source_at_sink(scene, scene.sources[k], place(fmt::format("sources.{}.side", k)));
  }
  if (scene.physics.accumulate && scene.physics.diffusion == 0.0) {
    fail_input(place("physics.accumulate"), "needs Brownian motion", "expected diffusion as well");
  }
  check_surfaces(scene, place);
  check_names(scene, place);
  check_growth(scene, place);
  check_run(scene, place);
  check_thermostat(scene, place);
}

}  // namespace carom
