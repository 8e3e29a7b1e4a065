#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/invariants.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/size_law.hpp"
#include "core/start/initial_state.hpp"
#include "io/movie/frame.hpp"

namespace carom {

namespace {

// If only a mean square speed can be predicted, the scale ends at this multiple of it: the disks of the tail share a
// colour, but the others are not all dark.
constexpr double tail = 2.5;

// Ids are less than this.
constexpr Count most_ids = std::numeric_limits<DiskId>::max();

// The mean square speed after collisions have distributed the energy: 2 kT / m with kT = K / N, averaged over the
// disks. 0 for disks of one mass, since it is the present one then. Summed in order of ids, as all sums below: the same
// bits in any storage order.
double shared_square(const DisksInPieces& disks) {
  double kinetic = 0.0, inverse_mass = 0.0, least = HUGE_VAL, greatest = 0.0;
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const double mass = d.mass_of(i);
      kinetic += kinetic_energy_of(d, i);
      inverse_mass += 1.0 / mass;
      least = std::min(least, mass);
      greatest = std::max(greatest, mass);
    }
  });
  const auto n = static_cast<double>(disks.size());
  return least >= greatest ? 0.0 : 2.0 * (kinetic / n) * (inverse_mass / n);
}

// The distance along an axis of the box to the wall to which a disk falls. part: of gravity, towards low coordinates.
double way_down(double part, double coordinate, double radius, double length) {
  return std::max((part < 0.0 ? length - coordinate : coordinate) - radius, 0.0);
}

// The mean square speed that falling to the floor, and to a side wall, adds.
double falling_square(const DisksInPieces& disks, const Gravity& gravity, const Domain& box) {
  double across = 0.0, height = 0.0;
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const double r = d.radius_of(i);
      across += way_down(gravity.left, d.x[i], r, box.width);
      height += way_down(gravity.down, d.y[i], r, box.height);
    }
  });
  const double work = std::abs(gravity.down) * height + std::abs(gravity.left) * across;
  return disks.size() == 0 ? 0.0 : 2.0 * work / static_cast<double>(disks.size());
}

// The possible radii of a source's disks.
ValueRange radius_range(const Source& source) {
  const auto [smallest, largest] = ends_of_sizes(source.radius, source.mass);
  return {smallest.radius, largest.radius};
}
ValueRange mass_range(const Source& source) {
  const auto [smallest, largest] = ends_of_sizes(source.radius, source.mass);
  return {smallest.mass, largest.mass};
}

// For disks of this mass at a temperature.
double thermal_square(double temperature, double mass) {
  return mass > 0.0 ? tail * 2.0 * temperature / mass : 0.0;
}

double source_square(const Source& source) {
  if (source.velocities.kind == VelocityLaw::Kind::uniform)
    return 2.0 * source.velocities.limit * source.velocities.limit;
  if (source.velocities.kind != VelocityLaw::Kind::maxwell) return 0.0;
  return thermal_square(source.velocities.temperature, mass_range(source).low);
}

// The square speed that falling adds to disks from a source, from the middle of its side or region.
double falling_square(const Source& source, const Gravity& gravity, const Domain& box) {
  double x = 0.5 * (source.region_low.x + source.region_high.x);
  double y = 0.5 * (source.region_low.y + source.region_high.y);
  if (source.side) {
    x = *source.side == Side::left ? 0.0 : *source.side == Side::right ? box.width : 0.5 * box.width;
    y = *source.side == Side::bottom ? 0.0 : *source.side == Side::top ? box.height : 0.5 * box.height;
  }
  const double radius = radius_range(source).low;
  return 2.0 * (std::abs(gravity.down) * way_down(gravity.down, y, radius, box.height) +
                std::abs(gravity.left) * way_down(gravity.left, x, radius, box.width));
}

// The least mass that a disk may have; 0 without disks.
double least_mass(const Scene& scene, const SeenValues& seen) {
  double least = seen.any ? seen.mass.low : HUGE_VAL;
  for (const Source& source : scene.sources) least = std::min(least, mass_range(source).low);
  return least < HUGE_VAL ? least : 0.0;
}

// The square speeds that thermal sides and thermostats give to disks, and moving walls to disks at rest.
double driven_square(const Scene& scene, const SeenValues& seen) {
  double temperature = scene.physics.thermostat.temperature, speed = fastest_inner_wall(scene);
  for (const Side side : all_sides) {
    temperature = std::max(temperature, scene.box.temperature(side));
    speed = std::max(speed, scene.box.motions[static_cast<std::size_t>(side)].largest_speed());
  }
  return std::max(thermal_square(temperature, least_mass(scene, seen)), 4.0 * speed * speed);
}

// The number of decimals, at most four, with which multiples of the frame interval differ and are exact.
int decimals_for(double every, double t_end) {
  const double interval = every > 0.0 ? every : t_end;
  if (!(interval >= 1e-4 && t_end < 1e7)) return -1;
  int decimals = 0;
  for (double scaled = interval; decimals < 4 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled;
       scaled *= 10.0) {
    ++decimals;
  }
  return decimals;
}

}  // namespace

FrameStyle frame_style(const std::string& title, const Domain& box, const PictureLook& look, const SeenValues& seen) {
  const ValueRange range = colour_range(look, seen);
  return {title, box, range.high, 2, range.low, look, {}, seen.groups};
}

FrameStyle frame_style(const Scene& scene, const PictureLook& look, const SeenValues& seen) {
  FrameStyle style = frame_style(scene.title, scene.box, look, seen);
  style.time_decimals = decimals_for(scene.output.every, scene.run.t_end);
  style.group_ends = ends_of_groups(scene);
  style.groups = static_cast<DiskId>(scene.groups.size() + (scene.sources.empty() ? 0 : 1));
  for (const DiskGroup& group : scene.groups) {
    style.group_names.push_back(group.name);
    style.fixed_groups.push_back(group.fixed);
  }
  if (!scene.sources.empty()) style.group_names.emplace_back(sources_name);
  style.obstacles = obstacles_of(scene);
  style.wall_motions = motions_of(scene);
  return style;
}

SeenValues foreseen_values(const Scene& scene, const DisksInPieces& first) {
  const Physics& physics = scene.physics;
  SeenValues seen;
  seen.add(first, {});
  double square = seen.speed_square;
  if (!disks_dissipate(scene)) square = std::max(square, tail * shared_square(first));
  if (physics.gravity.acts()) square += falling_square(first, physics.gravity, scene.box);
  for (const Source& source : scene.sources) {
    square = std::max(square, source_square(source) + falling_square(source, physics.gravity, scene.box));
  }
  square = std::max(square, driven_square(scene, seen));
  if (physics.diffusion > 0.0 && scene.run.dt > 0.0) {
    const double brownian = 4.0 * physics.diffusion / scene.run.dt;  // mean of (u / dt)^2, of both components together
    square = physics.accumulate ? square + brownian : tail * brownian;
  }
  seen.speed_square = square;
  for (const Source& source : scene.sources) {
    const ValueRange radius = radius_range(source), mass = mass_range(source);
    seen.add_radius(radius.low, radius.high);
    seen.add_mass(mass.low, mass.high);
    seen.any = true;
    const double coming = std::min(source.rate * scene.run.t_end, static_cast<double>(source.limit.value_or(most_ids)));
    seen.last_id += static_cast<DiskId>(std::min(coming, static_cast<double>(most_ids - seen.last_id)));
  }
  return seen;
}

}  // namespace carom
