// Silos: disks poured at random into a box that they fill in part; their scene, and the forces on its sides.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom::test {

struct Silo {
  std::size_t disks = 100;
  double aspect = 1.0;  // height of the filling over the width
  double smallest = 0.4, largest = 0.6;
  double dt = 0.005;
};

// Packing fraction of the resting disks (about), and when they are poured.
inline constexpr double filled = 0.84, poured = 0.4;

// Gravity 1, density 1, restitution 0.5 of disks and walls.
inline Scene silo_scene(const Silo& silo) {
  const double a = silo.smallest;
  const double b = silo.largest;
  const double area = static_cast<double>(silo.disks) * std::numbers::pi * (a * a + a * b + b * b) / 3.0;
  const double width = std::sqrt(area / filled / silo.aspect);
  Scene scene = scene_of(Method::pairwise, width, area / poured / width, silo.dt, 0.0);
  scene.box.restitutions.fill(0.5);
  scene.physics.gravity = 1.0;
  scene.physics.restitution = 0.5;
  DiskGroup group;
  group.count = silo.disks;
  group.positions.kind = PositionLaw::Kind::random;
  group.radius.kind = SizeLaw::Kind::uniform;
  group.radius.low = a;
  group.radius.high = b;
  group.mass.kind = SizeLaw::Kind::from_other;
  group.mass.density = 1.0;
  scene.groups.push_back(group);
  // Fallen from the top, and then twenty times what a wave of that length takes.
  scene.run.t_end = std::sqrt(2.0 * scene.box.height) + 20.0 * std::sqrt(width * silo.aspect);
  return scene;
}

// The mean force on each side between two moments of a run, by Side; mass length / time^2.
inline std::array<double, 4> mean_forces(const Counters& before, const Counters& after, double time) {
  std::array<double, 4> force{};
  for (std::size_t k = 0; k < 4; ++k) force[k] = (after.wall_impulse[k] - before.wall_impulse[k]) / time;
  return force;
}

inline double weight_of(const Disks& disks, double gravity) {
  double weight = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) weight += disks.mass_of(i) * gravity;
  return weight;
}

// Force on a side of a liquid with the disks' weight and centre of mass: w h / (2 W), the height h twice that of the
// centre of mass.
inline double side_force_of_liquid(const Disks& disks, const Domain& box, double gravity) {
  double moment = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) moment += disks.mass_of(i) * gravity * disks.y[i];
  return moment / box.width;
}

}  // namespace carom::test
