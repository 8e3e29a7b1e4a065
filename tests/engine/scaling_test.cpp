// No hidden unit, no absolute tolerance: lengths, masses or times scaled by 2^20 or 2^-20 give the same bits, scaled.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/load/scene_file.hpp"
#include "core/start/growth.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/other_units.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

using test::scaled;
using test::Units;

const std::vector<Units> other_units{{0x1p20, 1, 1},  {0x1p-20, 1, 1}, {1, 0x1p20, 1},
                                     {1, 0x1p-20, 1}, {1, 1, 0x1p20},  {1, 1, 0x1p-20}};

void expect_equal(const State& a, const State& b) {
  EXPECT_EQ(a.disks.id, b.disks.id);
  EXPECT_EQ(a.disks.x, b.disks.x);
  EXPECT_EQ(a.disks.y, b.disks.y);
  EXPECT_EQ(a.disks.vx, b.disks.vx);
  EXPECT_EQ(a.disks.vy, b.disks.vy);
  EXPECT_EQ(a.disks.radius, b.disks.radius);
  EXPECT_EQ(a.disks.mass, b.disks.mass);
  EXPECT_EQ(a.disks.common_radius, b.disks.common_radius);
  EXPECT_EQ(a.disks.common_mass, b.disks.common_mass);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.counters.steps, b.counters.steps);
  EXPECT_EQ(a.counters.collisions, b.counters.collisions);
  EXPECT_EQ(a.counters.wall_collisions, b.counters.wall_collisions);
  EXPECT_EQ(a.counters.removed, b.counters.removed);
  EXPECT_EQ(a.counters.emitted, b.counters.emitted);
  EXPECT_EQ(a.counters.virial, b.counters.virial);
  EXPECT_EQ(a.counters.emitted_energy, b.counters.emitted_energy);
  for (int side = 0; side < 4; ++side) {
    EXPECT_EQ(a.counters.wall_impulse[side], b.counters.wall_impulse[side]);
    EXPECT_EQ(a.counters.side_energy[side], b.counters.side_energy[side]);
  }
  EXPECT_EQ(a.thermal_hits, b.thermal_hits);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t k = 0; k < a.obstacles.size(); ++k) {
    EXPECT_EQ(a.obstacles[k].x, b.obstacles[k].x);
    EXPECT_EQ(a.obstacles[k].y, b.obstacles[k].y);
    EXPECT_EQ(a.obstacles[k].radius, b.obstacles[k].radius);
  }
  ASSERT_EQ(a.loads.size(), b.loads.size());
  for (std::size_t k = 0; k < a.loads.size(); ++k) EXPECT_EQ(a.loads[k].force, b.loads[k].force);
}

// Initial state and run, in all units. Returns the end in the scene's own.
State expect_same_in_all_units(const Scene& scene) {
  const State start = initial_state(scene);
  const State end = test::run(scene, start);
  for (const Units& u : other_units) {
    SCOPED_TRACE(testing::Message() << scene.title << ", " << test::name_of(scene.run.method) << ", length " << u.length
                                    << ", mass " << u.mass << ", time " << u.time);
    const Scene other = scaled(scene, u);
    const State other_start = initial_state(other);
    expect_equal(other_start, scaled(start, u));
    expect_equal(test::run(other, other_start), scaled(end, u));
    if (testing::Test::HasFailure()) break;
  }
  return end;
}

// As in the files, their first hundred steps.
TEST(Scaling, ScenesOfTheFolder) {
  int run = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    Scene scene = load_scene(entry.path().string());
    if (scene.groups.empty() || scene.groups[0].count > 1000 || scene.run.dt == 0.0) continue;
    // Grown anew for each method and unit, which is slow where the address sanitizer watches.
    if (grows(scene)) scene = load_scene(entry.path().string(), {{"disks.0.count", "100"}});
    for (Method method : test::stepping_methods) {
      scene.run.method = method;
      scene.run.t_end = 100.0 * scene.run.dt;
      expect_same_in_all_units(scene);
      ++run;
    }
  }
  EXPECT_GE(run, 10) << "five scenes of the original, by two methods";
}

// A group of mixed sizes: every law has its turn.
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

// Gravity, restitution of disks and walls, Brownian motion both ways, each kind of side, sources of both kinds.
Scene random_scene(std::uint64_t seed, Method method) {
  test::Draws draws(seed);
  Scene s = test::scene_of(method, draws.in(14.0, 20.0), draws.in(14.0, 20.0), 0.02, 3.0);
  s.title = "random scene " + std::to_string(seed);
  s.seed = seed;
  const SideKind kinds[] = {SideKind::wall, SideKind::periodic, SideKind::sink};
  test::set_sides(s.box, kinds[draws.bits() % 3], kinds[draws.bits() % 3]);
  if (draws.bits() % 2 == 0) s.physics.gravity = draws.in(0.0, 1.0);
  if (draws.bits() % 2 == 0) s.physics.restitution = draws.in(0.3, 1.0);
  if (draws.bits() % 2 == 0) s.box.restitutions.fill(draws.in(0.3, 1.0));
  if (draws.bits() % 3 == 0) {
    s.physics.gravity = 0.0;
    s.physics.diffusion = draws.in(0.01, 0.2);
    s.physics.accumulate = draws.bits() % 3 == 0;
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

// A pile that has come to rest: loads, slop and the sweeps of the solver have no unit either.
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
