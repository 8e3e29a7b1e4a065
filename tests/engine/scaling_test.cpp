// No hidden unit and no absolute tolerance: lengths, masses or times scaled by 2^20 or 2^-20 give the same bits,
// scaled.
#include <gtest/gtest.h>

#include "core/scene/disk_group.hpp"
#include "core/scene/scene.hpp"
#include "core/start/growth.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/other_units.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/run_in_all_units.hpp"

namespace carom {
namespace {

using test::expect_same_in_all_units;

// A group with a size distribution; all laws occur in turn.
DiskGroup random_group(test::Draws& draws, Count count) {
  DiskGroup group;
  group.count = count;
  group.velocities.kind = draws.bits() % 2 == 0 ? VelocityLaw::Kind::maxwell : VelocityLaw::Kind::uniform;
  group.velocities.temperature = 3.0;
  group.velocities.limit = 2.0;
  group.radius.kind = SizeLaw::Kind::uniform;
  group.radius.low = 0.3;
  group.radius.high = 0.3 + draws.in(0.0, 1.0);
  group.mass.value = 2.0;
  switch (draws.bits() % 3) {
    case 0:
      group.mass.kind = SizeLaw::Kind::from_other;
      group.mass.density = 1.7;
      break;
    case 1:
      group.radius.kind = SizeLaw::Kind::from_other;
      group.radius.density = 1.3;
      group.mass.kind = SizeLaw::Kind::uniform;
      group.mass.low = 1.0;
      group.mass.high = 5.0;
      break;
    default:
      group.radius.kind = SizeLaw::Kind::constant;
      group.radius.value = 0.4;
  }
  return group;
}

// Half of the scenes have a restitution that depends on the speed, or a separate one for two groups, or both.
void add_restitution_law(test::Draws& draws, Scene& s) {
  RestitutionLaw& law = s.physics.law;
  if (draws.bits() % 4 == 0) {
    s.physics.restitution = 0.3;
    law.viscosity = draws.in(0.01, 0.3);
  }
  if (draws.bits() % 3 != 0) return;
  law.ends = ends_of_groups(s);
  law.pairs = {{0, 0, {draws.in(0.2, 1.0), 0.0}}, {0, 1, {0.4, draws.in(0.1, 0.4)}}};
}

// A third of the scenes without Brownian motion have rough disks, some of them with rough walls.
void add_roughness(std::uint64_t seed, Scene& s) {
  if (seed % 3 != 0 || s.physics.diffusion > 0.0) return;
  s.physics.surfaces = {0.5, {0.3, seed % 2 == 0 ? 0.4 : HUGE_VAL}, {}};
  if (seed % 2 == 0) s.physics.surfaces.walls = {0.7, 0.6};
  s.groups[0].spins.value = 2.5;
  s.groups[1].spins.temperature = 3.0;
  for (Source& source : s.sources) source.spins.temperature = 1.5;
}

// Gravity, restitution of disks and walls, both kinds of Brownian motion, each kind of side, and both kinds of sources.
Scene random_scene(std::uint64_t seed, Method method) {
  test::Draws draws(seed);
  Scene s = test::scene_of(method, draws.in(14.0, 20.0), draws.in(14.0, 20.0), 0.02, 3.0);
  s.title = "random scene " + std::to_string(seed);
  s.seed = seed;
  const SideKind kinds[] = {SideKind::wall, SideKind::periodic, SideKind::sink};
  test::set_sides(s.box, kinds[draws.bits() % 3], kinds[draws.bits() % 3]);
  if (draws.bits() % 2 == 0) s.physics.gravity = draws.in(0.0, 1.0);
  if (seed % 4 == 1) s.physics.gravity = {draws.in(-1.0, 1.0), draws.in(-1.0, 1.0)};
  if (draws.bits() % 2 == 0) s.physics.restitution = draws.in(0.3, 1.0);
  if (draws.bits() % 2 == 0) s.box.restitutions.fill(draws.in(0.3, 1.0));
  if (draws.bits() % 3 == 0) {
    s.physics.gravity = 0.0;
    s.physics.diffusion = draws.in(0.01, 0.2);
    s.physics.accumulate = draws.bits() % 3 == 0;
  }
  if (s.physics.diffusion == 0.0 && seed % 4 == 2) {
    s.physics.thermostat = {seed % 8 == 2 ? Thermostat::Kind::langevin : Thermostat::Kind::andersen, 0.7, 3.0, 0.05};
  }
  s.groups.push_back(random_group(draws, 20));
  s.groups.push_back(random_group(draws, 10));
  if (draws.bits() % 2 == 0) {
    Source source;
    source.rate = draws.in(1.0, 8.0);
    if (!s.box.periodic_x() && draws.bits() % 2 == 0) source.side = Side::left;
    source.region_low = {2.0, 2.0};
    source.region_high = {12.0, 12.0};
    const DiskGroup sizes = random_group(draws, 1);
    source.radius = sizes.radius;
    source.mass = sizes.mass;
    source.velocities = sizes.velocities;
    s.sources.push_back(source);
  }
  add_restitution_law(draws, s);
  add_roughness(seed, s);
  return s;
}

TEST(Scaling, RandomScenesWithEveryFeature) {
  Count collisions = 0;
  Count emitted = 0;
  Count removed = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    for (Method method : test::stepping_methods) {
      const State end = expect_same_in_all_units(random_scene(seed, method));
      collisions += end.counters.collisions;
      emitted += end.counters.emitted;
      removed += end.counters.removed;
    }
  }
  EXPECT_GT(collisions, 1000U);
  EXPECT_GT(emitted, 50U);
  EXPECT_GT(removed, 50U);
}

// A pile at rest: its loads, slop and the sweeps of the solver must not depend on units either.
TEST(Scaling, PileAtRest) {
  Scene s = test::scene_of(Method::pairwise, 8.0, 30.0, 0.01, 25.0);
  s.title = "pile";
  s.physics.gravity = 0.5;
  s.physics.restitution = 0.4;
  s.box.restitutions.fill(0.4);
  DiskGroup group;
  group.count = 14;
  group.radius.kind = SizeLaw::Kind::uniform;
  group.radius.low = 0.6;
  group.radius.high = 1.2;
  group.mass.kind = SizeLaw::Kind::from_other;
  group.mass.density = 1.0;
  s.groups.push_back(group);
  EXPECT_GT(expect_same_in_all_units(s).loads.size(), 14U);
}

}  // namespace
}  // namespace carom
