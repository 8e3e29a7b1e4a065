#include "core/load/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_message.hpp"
#include "core/base/machine_memory.hpp"
#include "core/base/short_number.hpp"
#include "core/disks/place_slack.hpp"
#include "core/load/brownian_warnings.hpp"
#include "core/load/memory_need.hpp"
#include "core/load/press_warning.hpp"
#include "core/load/settling_warning.hpp"
#include "core/load/wall_warnings.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_output.hpp"
#include "core/scene/scene_range_check.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/scene_roughness.hpp"
#include "core/scene/scene_thermostat.hpp"
#include "core/scene/size_law.hpp"
#include "core/step/window_plan.hpp"

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

// Walls must be within the box, and end at periodic sides, too.
void check_wall(const Scene& scene, const InnerWall& wall, const std::string& path, const PlaceOfKey& place) {
  const Domain& box = scene.box;
  for (const Vec2& p : wall.points) {
    if (p.x >= 0.0 && p.y >= 0.0 && p.x <= box.width && p.y <= box.height) continue;
    fail_input(place(path),
               fmt::format("the point [{}, {}] lies outside the box of {} x {}", p.x, p.y, box.width, box.height),
               "expected walls within the box");
  }
  if (wall.sink && scene.physics.diffusion > 0.0) {
    fail_input(place(path + ".kind"),
               "a sink inside the box cannot be used with Brownian motion: disks may cross it between two steps",
               "expected a side of the box as sink, or no diffusion");
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

// Checks for sizes out of range: drawn, from a list or an earlier run, or derived from each other.
void check_sizes(const DiskSize& smallest, const DiskSize& largest, const std::string& path, const PlaceOfKey& place) {
  const auto check = [&](std::string_view name, Dimension dimension, double low, double high) {
    if (low > 0.0 && in_range(dimension, low) && in_range(dimension, high)) return;
    const std::string what =
        low == high ? fmt::format("gets the value {}", low) : fmt::format("gets values between {} and {}", low, high);
    fail_input(place(fmt::format("{}.{}", path, name)), what, expected_range(dimension));
  };
  check("radius", Dimension::length, smallest.radius, largest.radius);
  check("mass", Dimension::mass, smallest.mass, largest.mass);
}

void check_axis(double length, bool periodic, double radius, std::string_view name, const PlaceOfKey& place) {
  // In a period below two diameters, two disks of the same diameter could touch through two images at the same time.
  const double least = periodic ? 4.0 * radius : 2.0 * radius;
  if (length >= least) return;
  fail_input(place(fmt::format("box.{}", name)), fmt::format("{} is too small for a disk of radius {}", length, radius),
             fmt::format("expected at least {}, {} of the largest disk", least,
                         periodic ? "two diameters (periodic sides)" : "the diameter"));
}

// Is there a place in [low, high] for the centre of a disk of this radius? A single place may touch a side in decimals.
bool fits_along(double low, double high, double length, bool periodic, double radius) {
  if (periodic) return true;
  const double first = std::max(low, radius);
  const double last = std::min(high, length - radius);
  return low < high ? first < last : first <= last + place_slack(radius, length);
}

// radius: the largest that the source can give. A disk too large for the region would block all that follow it.
void check_region(const Source& source, const Domain& box, double radius, const std::string& where) {
  const Vec2 low = source.region_low;
  const Vec2 high = source.region_high;
  constexpr std::string_view expected = "expected [x0, y0, x1, y1] with x0 <= x1, y0 <= y1, inside the box";
  if (!(low.x <= high.x && low.y <= high.y)) fail_input(where, "its corners are not in order", expected);
  if (!(low.x >= 0.0 && low.y >= 0.0 && high.x <= box.width && high.y <= box.height)) {
    fail_input(where, fmt::format("reaches out of the box of {} x {}", box.width, box.height), expected);
  }
  if (fits_along(low.x, high.x, box.width, box.periodic_x(), radius) &&
      fits_along(low.y, high.y, box.height, box.periodic_y(), radius)) {
    return;
  }
  fail_input(where,
             fmt::format("has no place for the centre of a disk of radius {}: all of it is closer to a side", radius),
             "expected a region with places at least a radius from each side that is not periodic");
}

// radius: the largest of the group.
void check_start_region(const StartRegion& region, const Domain& box, double radius, const std::string& where) {
  const Vec2 low = region.low;
  const Vec2 high = region.high;
  constexpr std::string_view expected =
      "expected [x0, y0, x1, y1] with x0 < x1, y0 < y1, or { circle = [x, y, r] }, inside the box";
  if (!(low.x < high.x && low.y < high.y)) fail_input(where, "its corners are not in order", expected);
  // The edge of a circle is a sum, which rounding may put beyond a side that it touches.
  const double slack = region.circle ? place_slack(box, region.radius) : 0.0;
  if (!(low.x >= -slack && low.y >= -slack && high.x <= box.width + slack && high.y <= box.height + slack)) {
    fail_input(where, fmt::format("reaches out of the box of {} x {}", box.width, box.height), expected);
  }
  // One row of disks may fill it in decimals.
  const double least = 2.0 * radius - place_slack(box, radius);
  if (high.x - low.x >= least && high.y - low.y >= least) return;
  fail_input(where, fmt::format("is too small for a disk of radius {}", radius),
             "expected a region that holds whole disks");
}

void check_drift(const Scene& scene, const DiskGroup& group, const std::string& path, const PlaceOfKey& place) {
  if (group.drift == Vec2{}) return;
  VelocityLaw drift;
  drift.kind = VelocityLaw::Kind::list;
  drift.list = {group.drift};
  check_velocities(scene, drift, 0.0, path, [&](std::string_view) { return place(fmt::format("{}.drift", path)); });
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

namespace {

// Warns if frames or samples are wanted at shorter intervals than dt, except for the default interval, a hundredth of
// the run.
void warn_of_interval(const Scene& scene, const char* key, double every, std::vector<std::string>& warnings) {
  constexpr double rounding = 1e-6;
  const bool steps = scene.run.method != Method::exact;
  if (!steps || every == scene.run.t_end / 100.0 || !(every > 0.0 && every < (1.0 - rounding) * scene.run.dt)) return;
  warnings.push_back(
      fmt::format("{}: {}: is {:g}, shorter than dt = {:g}: time stepping has states only at the ends of its steps",
                  scene.file, key, every, scene.run.dt));
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  if (scene.physics.collapse_contact_time && scene.run.method != Method::exact) {
    warnings.push_back(fmt::format("{}: physics.collapse: only the exact method uses it, method {} does not",
                                   scene.file, name_of(scene.run.method)));
  }
  if (scene.physics.collapse_contact_time && scene.run.method == Method::exact && !has_tc(scene)) {
    warnings.push_back(
        fmt::format("{}: physics.collapse: restitution and wall_restitution are 1, so no energy is lost and the TC "
                    "model does nothing",
                    scene.file));
  }
  for (const auto warnings_of : {brownian_warnings, settling_warnings, wall_warnings, press_warnings}) {
    for (std::string& warning : warnings_of(scene)) warnings.push_back(std::move(warning));
  }
  warn_of_interval(scene, "output.every", scene.output.every, warnings);
  if (scene.analysis.any() && scene.analysis.every != scene.output.every)
    warn_of_interval(scene, "analysis.every", scene.analysis.every, warnings);
  if (scene.run.accuracy > 0.0 && !scene.run.automatic) {
    warnings.push_back(fmt::format("{}: run.accuracy: only method \"auto\" uses it, method {} does not", scene.file,
                                   name_of(scene.run.method)));
  }
  return warnings;
}

namespace {

// The sizes of all disks that a scene has or its sources bring.
struct SizesOfAll {
  double smallest = 0.0;  // radius; 0: no disk yet
  double largest = 0.0;
  double largest_to_move = 0.0;  // fixed disks may be wider than the box
  double lightest = 0.0;

  void add(const DiskSize& low, const DiskSize& high, bool fixed) {
    smallest = smallest > 0.0 ? std::min(smallest, low.radius) : low.radius;
    largest = std::max(largest, high.radius);
    if (fixed) return;  // their masses are not used
    lightest = lightest > 0.0 ? std::min(lightest, low.mass) : low.mass;
    largest_to_move = std::max(largest_to_move, high.radius);
  }
};

void check_disks_of_groups(const Scene& scene, const PlaceOfKey& place, SizesOfAll& all) {
  DiskId first_id = 0;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    const DiskGroup& group = scene.groups[g];
    if (group.count == 0) continue;
    const std::string path = fmt::format("disks.{}", g);
    const SizeSummary sizes = summarise_sizes(group, scene.seed, first_id);
    check_sizes(sizes.smallest, sizes.largest, path, place);
    check_velocities(scene, group.velocities, sizes.smallest.mass, path, place);
    check_drift(scene, group, path, place);
    check_spins(scene, group.spins, sizes.smallest.mass, sizes.largest.radius, path, place);
    if (group.positions.region) {
      check_start_region(*group.positions.region, scene.box, sizes.largest.radius, place(path + ".region"));
    }
    all.add(sizes.smallest, sizes.largest, group.fixed);
    first_id += static_cast<DiskId>(group.count);
  }
}

void check_disks_of_sources(const Scene& scene, const PlaceOfKey& place, SizesOfAll& all) {
  for (std::size_t k = 0; k < scene.sources.size(); ++k) {
    const Source& source = scene.sources[k];
    const std::string path = fmt::format("sources.{}", k);
    const auto [low, high] = ends_of_sizes(source.radius, source.mass);
    check_sizes(low, high, path, place);
    check_velocities(scene, source.velocities, low.mass, path, place);
    check_spins(scene, source.spins, low.mass, high.radius, path, place);
    check_emissions(scene, source, path, place);
    all.add(low, high, false);
    if (!source.side) check_region(source, scene.box, high.radius, place(path + ".region"));
  }
}

}  // namespace

double check_box(const Scene& scene, const PlaceOfKey& place) {
  check_box_range(scene, place);
  check_times(scene, place);
  SizesOfAll all;
  check_disks_of_groups(scene, place, all);
  check_disks_of_sources(scene, place, all);
  for (std::size_t k = 0; k < scene.walls.size(); ++k)
    check_wall(scene, scene.walls[k], fmt::format("walls.{}", k), place);
  const Domain& box = scene.box;
  check_axis(box.width, box.periodic_x(), box.periodic_x() ? all.largest : all.largest_to_move, "width", place);
  check_axis(box.height, box.periodic_y(), box.periodic_y() ? all.largest : all.largest_to_move, "height", place);
  check_resolution(scene, all.smallest, place);
  check_thermal_sides(scene, all.lightest, place);
  check_selection(scene, place);
  return all.largest_to_move;
}

}  // namespace carom
