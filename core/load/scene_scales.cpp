#include "core/load/scene_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/scene/size_law.hpp"
#include "core/step/step_start.hpp"

namespace carom {

namespace {

// The packing fraction assumed for the collisions of a settling scene, when disks have come down.
constexpr double settled_fraction = 0.6;

// Summary of a velocity law: the means of v_x^2 and of m v_x^2, and the speed of the fastest disk.
struct LawSpeeds {
  double square = 0.0, temperature = 0.0, fastest = 0.0;
};

// For disks with these mean masses.
LawSpeeds speeds_of(const VelocityLaw& law, double mean_mass, double mean_inverse_mass, double lightest) {
  switch (law.kind) {
    case VelocityLaw::Kind::maxwell:
      return {law.temperature * mean_inverse_mass, law.temperature,
              fastest_share * std::sqrt(law.temperature / lightest)};
    case VelocityLaw::Kind::uniform: {
      const double square = law.limit * law.limit / 3.0;
      return {square, mean_mass * square, std::numbers::sqrt2 * law.limit};
    }
    case VelocityLaw::Kind::list: {
      if (law.list.empty()) return {};
      double sum = 0.0, most = 0.0;
      for (const Vec2& v : law.list) {
        const double square = v.x * v.x + v.y * v.y;
        sum += 0.5 * square;
        most = std::max(most, square);
      }
      const double mean = sum / static_cast<double>(law.list.size());
      return {mean, mean_mass * mean, std::sqrt(most)};
    }
    default:
      return {};
  }
}

// Mean of I w^2 of rough disks of this mass and radius; 0 for smooth disks.
double mean_spin_energy(const Scene& scene, const SpinLaw& law, double mass, double radius) {
  if (!scene.physics.surfaces.are_rough()) return 0.0;
  if (law.temperature > 0.0) return law.temperature;
  double sum = 0.0;
  for (const double w : law.list) sum += w * w;
  const double mean = law.list.empty() ? law.value * law.value : sum / static_cast<double>(law.list.size());
  return scene.physics.surfaces.inertia * mass * radius * radius * mean;
}

// Sums over the disks of the scene.
struct Tally {
  double disks = 0.0, radius2 = 0.0, speed2 = 0.0;
  double temperature = 0.0;   // of what collisions share out: sum of m v_x^2, and of spins a third of I w^2
  double inverse_mass = 0.0;  // sum of 1 / m
  double smallest = std::numeric_limits<double>::infinity();  // radius
  double lightest = std::numeric_limits<double>::infinity();  // mass
  double fastest = 0.0;                                       // speed of a disk at the start

  // Adds `count` disks of these sizes. drift: a velocity added to all of theirs.
  void add(double count, const SizeSummary& sizes, const VelocityLaw& law, Vec2 drift, const Scene& scene,
           const SpinLaw& spins) {
    if (!(count > 0.0)) return;
    const double mean_mass = sizes.mass / count;
    const LawSpeeds speeds = speeds_of(law, mean_mass, sizes.inverse_mass / count, sizes.smallest.mass);
    const double drift2 = drift.x * drift.x + drift.y * drift.y;
    const double spin_energy = mean_spin_energy(scene, spins, mean_mass, sizes.largest.radius);
    temperature += count * (speeds.temperature + 0.5 * mean_mass * drift2 + spin_energy / 3.0);
    inverse_mass += sizes.inverse_mass;
    lightest = std::min(lightest, sizes.smallest.mass);
    disks += count;
    radius2 += sizes.radius_squared;
    speed2 += count * (speeds.square + 0.5 * drift2);
    smallest = std::min(smallest, sizes.smallest.radius);
    fastest = std::max(fastest, speeds.fastest + std::sqrt(drift2));
  }
};

// The sizes of `count` disks of a source, estimated from the first thousand.
SizeSummary sizes_of(const Source& source, double count, std::uint64_t seed) {
  constexpr double most_draws = 1000.0;
  SizeSummary sum;
  const auto draws = static_cast<Count>(std::ceil(std::min(count, most_draws)));
  for (Count k = 0; k < draws; ++k) {
    const DiskSize size = draw_size(source.radius, source.mass, seed, Stream::source_radius, Stream::source_mass,
                                    static_cast<DiskId>(k), k);
    const double share = count / static_cast<double>(draws);
    if (k == 0) sum.smallest = sum.largest = size;
    sum.smallest = {std::min(sum.smallest.radius, size.radius), std::min(sum.smallest.mass, size.mass)};
    sum.largest = {std::max(sum.largest.radius, size.radius), std::max(sum.largest.mass, size.mass)};
    sum.radius_squared += share * size.radius * size.radius;
    sum.mass += share * size.mass;
    sum.inverse_mass += share / size.mass;
  }
  return sum;
}

Tally tally_of(const Scene& scene) {
  Tally tally;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    if (!group.fixed) {
      tally.add(static_cast<double>(group.count), summarise_sizes(group, scene.seed, first_id), group.velocities,
                group.drift, scene, group.spins);
    }
    first_id += static_cast<DiskId>(group.count);
  }
  for (const Source& source : scene.sources) {
    double count = source.rate * scene.run.t_end;
    if (source.limit) count = std::min(count, static_cast<double>(*source.limit));
    tally.add(count, sizes_of(source, count, scene.seed), source.velocities, {}, scene, source.spins);
  }
  return tally;
}

// The highest temperature of the thermostat and the thermal sides, which the gas approaches but does not exceed; 0 if
// there are none.
double hottest_bath(const Scene& scene) {
  const double hottest = *std::max_element(scene.box.temperatures.begin(), scene.box.temperatures.end());
  return std::max(hottest, scene.physics.thermostat.temperature);
}

// The largest speed of a moving side or inner wall, and the largest angular frequency of the vibrating ones.
struct WallDrive {
  bool moves = false;
  double speed = 0.0, vibration = 0.0;  // length / time, 1 / time

  void see(const SideMotion& pace, double fastest) {
    moves |= pace.moves();
    speed = std::max(speed, fastest);
    if (pace.vibrates()) vibration = std::max(vibration, pace.angular_frequency());
  }
};

WallDrive wall_drive(const Scene& scene) {
  WallDrive drive;
  for (const SideMotion& motion : scene.box.motions) drive.see(motion, motion.largest_speed());
  for (const InnerWall& wall : scene.walls) drive.see(wall.motion.pace, wall.motion.largest_speed());
  return drive;
}

// The least restitution of two disks of any groups, at the speeds at which laws dissipate most.
double least_restitution(const Scene& scene) {
  double e = scene.physics.restitution;
  for (const GroupPair& pair : scene.physics.law.pairs) e = std::min(e, pair.restitution.least);
  return e;
}

// The same in the limit of slow disks, where laws with a viscosity tend to 1.
double least_restitution_at_rest(const Scene& scene) {
  const RestitutionLaw& law = scene.physics.law;
  double e = law.viscosity == 0.0 ? scene.physics.restitution : 1.0;
  for (const GroupPair& pair : law.pairs) {
    if (pair.restitution.viscosity == 0.0) e = std::min(e, pair.restitution.least);
  }
  return e;
}

// Does gravity press disks against an obstacle that dissipates? e: restitution of two disks.
bool rests_on_obstacles(const Scene& scene, double e) {
  const Gravity& g = scene.physics.gravity;
  for (const InnerWall& wall : scene.walls) {
    if (wall.sink || wall.restitution >= 1.0) continue;
    for (std::size_t k = 1; k < wall.points.size(); ++k) {
      const Vec2 along{wall.points[k].x - wall.points[k - 1].x, wall.points[k].y - wall.points[k - 1].y};
      if (along.x * g.down - along.y * g.left != 0.0) return true;
    }
  }
  const auto is_peg = [](const DiskGroup& group) { return group.fixed && group.count > 0; };
  return e < 1.0 && std::any_of(scene.groups.begin(), scene.groups.end(), is_peg);
}

// Inelastic collapse occurs in two dimensions for e <= 0.6 (McNamara and Young 1996). Under gravity any disk on a
// floor, an inner wall or between fixed disks that dissipate collapses, and so does a pile of more disks than ln(4 / (1
// - e)) / (1 - e), the number in a column that collapses. A restitution that tends to 1 for slow disks prevents
// collapse in a gas (Goldman et al. 1998), but not in a pile, where bounces become shorter and shorter all the same.
bool may_collapse(const Scene& scene, double disks) {
  constexpr double two_dimensions = 0.6;
  if (!settles(scene)) return least_restitution_at_rest(scene) <= two_dimensions && disks > 2.0;
  const double e = least_restitution(scene);
  for (const Side side : all_sides) {
    const bool presses = outward_acceleration(side, scene.physics.gravity) > 0.0;
    if (presses && scene.box.side(side) == SideKind::wall && scene.box.restitution(side) < 1.0) return true;
  }
  if (rests_on_obstacles(scene, e)) return true;
  return e < 1.0 && disks > std::log(4.0 / (1.0 - e)) / (1.0 - e);
}

// Walls and fixed disks as a disk's centre meets them: their total length, and the area that is left to it.
struct Confinement {
  double length = 0.0, area = 0.0;
};

Confinement confinement(const Scene& scene, double diameter) {
  constexpr double least_share = 1e-3;  // of a diameter: a lower bound where disks hardly fit
  const Domain& box = scene.box;
  const auto walls = [&](Side a, Side b) {
    return static_cast<double>(box.side(a) == SideKind::wall) + static_cast<double>(box.side(b) == SideKind::wall);
  };
  const double least = least_share * diameter;
  const double width = std::max(least, box.width - 0.5 * diameter * walls(Side::left, Side::right));
  const double height = std::max(least, box.height - 0.5 * diameter * walls(Side::bottom, Side::top));
  Confinement c{walls(Side::left, Side::right) * height + walls(Side::bottom, Side::top) * width, width * height};
  double taken = 0.0;
  DiskId first_id = 0;
  for (const DiskGroup& group : scene.groups) {
    if (group.fixed) {
      const double count = static_cast<double>(group.count);
      const double square = summarise_sizes(group, scene.seed, first_id).radius_squared;
      const double reach = count > 0.0 ? std::sqrt(square / count) + 0.5 * diameter : 0.0;
      c.length += count * 2.0 * std::numbers::pi * reach;
      taken += count * std::numbers::pi * reach * reach;
    }
    first_id += static_cast<DiskId>(group.count);
  }
  for (const InnerWall& wall : scene.walls) {
    for (std::size_t k = 1; k < wall.points.size() && !wall.sink; ++k) {
      const double length =
          std::hypot(wall.points[k].x - wall.points[k - 1].x, wall.points[k].y - wall.points[k - 1].y);
      c.length += 2.0 * length;
      taken += length * diameter;
    }
  }
  constexpr double least_left = 0.05;  // of the box: a lower bound where fixed disks and walls overlap
  c.area *= std::max(least_left, 1.0 - taken / c.area);
  return c;
}

}  // namespace

double compressibility(double eta) {
  const double free = 1.0 - eta;
  return (1.0 + eta * eta / 8.0) / (free * free) - eta * eta * eta * eta / (64.0 * free * free * free * free);
}

SceneScales scales_of(const Scene& scene) {
  const Tally tally = tally_of(scene);
  SceneScales s;
  s.disks = tally.disks;
  if (!(s.disks > 0.0)) return s;
  s.settles = settles(scene);
  s.smallest_radius = tally.smallest;
  s.diameter = 2.0 * std::sqrt(tally.radius2 / tally.disks);
  s.packing_fraction = std::min(0.9, std::numbers::pi * tally.radius2 / (scene.box.width * scene.box.height));
  // Collisions equalise energies, so that light disks become faster than heavy ones.
  const double shared2 = tally.temperature / tally.disks * tally.inverse_mass / tally.disks;
  const double thermal2 = std::max({tally.speed2 / tally.disks, shared2, hottest_bath(scene) / tally.lightest});
  // A moving wall gives a disk at rest twice its speed.
  const WallDrive drive = wall_drive(scene);
  s.driven = drive.moves;
  s.vibration = drive.vibration;
  const double speed2 = thermal2 + 4.0 * drive.speed * drive.speed;
  // On average a disk falls through half the box: v^2 = g H, half of it for each component.
  const Gravity& g = scene.physics.gravity;
  const double fall2 = std::abs(g.down) * scene.box.height + std::abs(g.left) * scene.box.width;
  s.speed = std::sqrt(speed2 + 0.5 * fall2);
  // A disk of the smallest mass may be faster than fastest_share times the mean; so may one that starts at a speed of
  // its own.
  const double hottest = std::max(tally.temperature / tally.disks, hottest_bath(scene));
  const double fast = std::max(tally.fastest, fastest_share * std::sqrt(hottest / tally.lightest));
  s.fastest = std::max(fastest_share * s.speed, std::sqrt(fast * fast + fall2) + 2.0 * drive.speed);
  const double eta = s.settles ? std::max(settled_fraction, s.packing_fraction) : s.packing_fraction;
  s.collision_rate =
      s.disks > 1.0 ? 4.0 * (compressibility(eta) - 1.0) * s.speed / (std::sqrt(std::numbers::pi) * s.diameter) : 0.0;
  const Confinement around = confinement(scene, s.diameter);
  s.wall_rate = s.speed * around.length / (std::sqrt(2.0 * std::numbers::pi) * around.area);
  s.may_collapse = may_collapse(scene, s.disks);
  s.restitution = least_restitution(scene);
  s.stopping = s.settles && s.restitution < 1.0 ? 1.0 / (1.0 - s.restitution * s.restitution) : 0.0;
  return s;
}

}  // namespace carom
