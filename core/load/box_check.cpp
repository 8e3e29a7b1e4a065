#include "core/load/box_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/input_message.hpp"
#include "core/disks/place_slack.hpp"
#include "core/scene/scene_output.hpp"
#include "core/scene/scene_range_check.hpp"
#include "core/scene/scene_ranges.hpp"
#include "core/scene/scene_roughness.hpp"
#include "core/scene/size_law.hpp"

namespace carom {

namespace {

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
