// One test for each fault of the original (docs/original.md) that both stepping methods remedy. Each test states a
// condition, and checks that it holds in Carom and fails in the original (tests/support/original.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/check.hpp"
#include "core/measure/invariants.hpp"
#include "core/reference/pair_search.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/original.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

using test::original::Options;

using Holds = std::function<bool(const Disks&)>;

// Does the condition hold after every step of Carom?
bool always(const Scene& scene, const State& start, const Holds& holds) {
  bool held = true;
  test::run(scene, start, [&](const Engine& engine) { held = held && holds(engine.state().disks); });
  return held;
}

// Does it hold after every frame of the original, for as many frames as the run has steps?
bool always_in_original(const Scene& scene, const State& start, const Holds& holds, const Options& options = {}) {
  Disks disks = start.disks;
  bool held = true;
  for (int k = 0; k < static_cast<int>(scene.run.t_end / scene.run.dt + 0.5); ++k) {
    test::original::frame(disks, scene, options);
    held = held && holds(disks);
  }
  return held;
}

Holds conserves(const Disks& start, double gravity = 0.0) {
  const Momentum p = momentum_of(start);
  const double energy = energy_of(start, gravity).total();
  return [=](const Disks& d) {
    const Momentum now = momentum_of(d);
    return std::abs(now.x - p.x) <= 1e-12 * p.magnitude && std::abs(now.y - p.y) <= 1e-12 * p.magnitude &&
           std::abs(energy_of(d, gravity).total() - energy) <= 1e-12 * energy;
  };
}

bool all_finite(const Disks& d) {
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!std::isfinite(d.x[i] + d.y[i] + d.vx[i] + d.vy[i])) return false;
  }
  return true;
}

class Faults : public testing::TestWithParam<Method> {
 protected:
  Scene scene(double side, double dt, double t_end) const { return test::scene_of(GetParam(), side, side, dt, t_end); }
};

INSTANTIATE_TEST_SUITE_P(Methods, Faults, testing::ValuesIn(test::stepping_methods),
                         [](const auto& method) { return test::name_of(method.param); });

// One disk meets two at the same moment: momentum and energy must still be conserved.
TEST_P(Faults, F03_DiskInTwoPairsAtOnce) {
  const Scene s = scene(20.0, 0.03, 3.0);
  const State start = test::state_of(
      s, {{4.0, 5.0, 1.0, 0.0, 0.5, 1.0}, {5.8, 5.6, 0.0, 0.0, 0.5, 2.0}, {5.8, 4.4, 0.0, 0.0, 0.5, 3.0}});
  EXPECT_TRUE(always(s, start, conserves(start.disks)));
  EXPECT_GE(test::run(s, start).counters.collisions, 2U);
  EXPECT_FALSE(always_in_original(s, start, conserves(start.disks)));
}

// Elastic disks with unequal masses: (23) must hold, not the exchange (16).
TEST_P(Faults, F04_SwapWithUnequalMasses) {
  const Scene s = scene(20.0, 0.03, 3.0);
  const State start = test::state_of(s, {{6.0, 5.0, 1.0, 0.0, 0.5, 1.0}, {8.5, 5.3, 0.0, 0.0, 0.5, 7.0}});
  EXPECT_TRUE(always(s, start, conserves(start.disks)));
  EXPECT_EQ(test::run(s, start).counters.collisions, 1U);
  Options options;
  EXPECT_TRUE(always_in_original(s, start, conserves(start.disks), options));
  options.swap = true;
  EXPECT_FALSE(always_in_original(s, start, conserves(start.disks), options));
}

// A step of 30 radii: no disk passes through another, and the exact position is reached.
TEST_P(Faults, F05_TunnellingThroughADisk) {
  const Scene s = scene(100.0, 1.0, 2.0);
  const State start = test::state_of(s, {{5.0, 50.0, 30.0, 0.0, 1.0, 1.0}, {50.0, 50.0, 0.0, 0.0, 1.0, 1.0}});
  const Holds in_order = [](const Disks& d) { return d.x[0] < d.x[1]; };
  EXPECT_TRUE(always(s, start, in_order));
  EXPECT_FALSE(always_in_original(s, start, in_order));
  const State end = test::run(s, start);
  EXPECT_EQ(end.counters.collisions, 1U);
  EXPECT_NEAR(end.disks.x[0], 48.0, 1e-12);
  EXPECT_NEAR(end.disks.x[1], 50.0 + 60.0 - 43.0, 1e-12);
}

TEST_P(Faults, F05_TunnellingThroughAWall) {
  const Scene s = scene(100.0, 1.0, 3.0);
  const State start = test::state_of(s, {{90.0, 50.0, 30.0, 0.0, 1.0, 1.0}});
  const Holds inside = [&](const Disks& d) { return wall_overlap(d, s.box) <= 1e-12; };
  EXPECT_TRUE(always(s, start, inside));
  EXPECT_FALSE(always_in_original(s, start, inside));
  EXPECT_NEAR(test::run(s, start).disks.x[0], 18.0, 1e-12);
}

// Gravity counts, too: the disk is at rest now, but will fall by 50 radii in the step.
TEST_P(Faults, F05_TunnellingByFalling) {
  Scene s = scene(100.0, 1.0, 2.0);
  s.physics.gravity = 100.0;
  const State start = test::state_of(s, {{50.0, 60.0, 0.0, 0.0, 1.0, 1.0}, {50.0, 30.0, 0.0, 0.0, 1.0, 1.0}});
  EXPECT_TRUE(always(s, start, [](const Disks& d) { return d.y[0] > d.y[1]; }));
  EXPECT_FALSE(always_in_original(s, start, [](const Disks& d) { return d.y[0] > d.y[1] && d.y[1] > 0.0; }));
}

// The step is split, with a single warning; an absurd speed stops the run with an error.
TEST_P(Faults, F05_SaysThatTheStepIsTooLong) {
  const Scene s = scene(100.0, 1.0, 2.0);
  const auto engine = make_reference_engine(s, test::state_of(s, {{50.0, 50.0, 30.0, 0.0, 1.0, 1.0}}));
  engine->step();
  const auto warnings = engine->take_warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("split into 60 parts"), std::string::npos) << warnings[0];
  engine->step();
  EXPECT_TRUE(engine->take_warnings().empty());
  const auto absurd = make_reference_engine(s, test::state_of(s, {{50.0, 50.0, 1e6, 0.0, 1.0, 1.0}}));
  EXPECT_THROW(absurd->step(), PhysicsError);
}

// A disk of radius 20 with cells of 20: its edge lies in cells that contain none of its corners.
TEST_P(Faults, F06_DiskLargerThanACell) {
  const Scene s = scene(100.0, 0.05, 5.0);
  const State start = test::state_of(s, {{50.0, 50.0, 0.0, 0.0, 20.0, 100.0}, {26.0, 50.0, 1.0, 0.0, 1.0, 1.0}});
  const Holds apart = [&](const Disks& d) { return max_overlap(d, s.box) <= 1e-12; };
  EXPECT_TRUE(always(s, start, apart));
  EXPECT_FALSE(always_in_original(s, start, apart));
  EXPECT_EQ(test::run(s, start).counters.collisions, 1U);
}

// Does the first step find the single pair that overlaps after its drift, while the original's cells do not?
void expect_seen_in_first_step(const Scene& scene, const State& start) {
  Disks drifted = start.disks;
  test::original::move(drifted, scene.run.dt, scene.physics.gravity);
  EXPECT_EQ(find_touching_pairs(drifted, scene.box).size(), 1U);
  EXPECT_TRUE(test::original::pairs(drifted, scene.box).empty());
  const auto engine = make_reference_engine(scene, start);
  engine->step();
  EXPECT_EQ(engine->state().counters.collisions, 1U);
}

// The lower corners of the large disk are below the floor and have no cell; the small disk meets it near them.
TEST_P(Faults, F07_CornersOutsideTheBox) {
  const Scene s = scene(100.0, 0.05, 1.0);
  expect_seen_in_first_step(s,
                            test::state_of(s, {{30.0, 10.9, 0.0, 0.0, 11.0, 9.0}, {20.95, 3.0, 1.0, 0.0, 1.0, 1.0}}));
}

// An overlapping pair that already separates must not be changed.
TEST_P(Faults, F08_SeparatingPairIsNotReversed) {
  Scene s = scene(20.0, 0.01, 0.5);
  s.physics.restitution = 0.5;
  const State start = test::state_of(s, {{9.0, 5.0, -1.0, 0.0, 1.0, 1.0}, {10.9, 5.0, 1.0, 0.0, 1.0, 1.0}});
  const Holds parting = [](const Disks& d) { return d.x[0] < d.x[1] && d.vx[0] == -1.0 && d.vx[1] == 1.0; };
  EXPECT_TRUE(always(s, start, parting));
  EXPECT_FALSE(always_in_original(s, start, parting));
  const State end = test::run(s, start);
  EXPECT_EQ(end.counters.collisions, 0U);
  EXPECT_EQ(max_overlap(end.disks, s.box), 0.0);
}

// Overlapping disks with equal velocities: there is no contact to go back to, and no relative speed to divide by.
TEST_P(Faults, F09_NoRelativeMotion) {
  const Scene s = scene(20.0, 0.01, 0.5);
  const State start = test::state_of(s, {{9.0, 5.0, 0.5, 0.25, 1.0, 1.0}, {10.9, 5.0, 0.5, 0.25, 1.0, 1.0}});
  const Holds goes_on = [](const Disks& d) {
    return all_finite(d) && d.vx[0] == 0.5 && d.vx[1] == 0.5 && d.vy[0] == 0.25 && d.vy[1] == 0.25;
  };
  EXPECT_TRUE(always(s, start, goes_on));
  EXPECT_FALSE(always_in_original(s, start, goes_on));
  EXPECT_EQ(test::run(s, start).time, 0.5);
}

// Two disks that meet across a periodic side, along x and along y: they exchange velocities.
TEST_P(Faults, F10_PeriodicImages) {
  for (const bool along_x : {true, false}) {
    Scene s = scene(10.0, 0.03, 1.5);
    test::set_sides(s.box, SideKind::periodic, SideKind::periodic);
    State start = test::state_of(s, {{1.5, 5.0, -1.0, 0.0, 1.0, 1.0}, {8.5, 5.0, 1.0, 0.0, 1.0, 1.0}});
    if (!along_x) {
      std::swap(start.disks.x, start.disks.y);
      std::swap(start.disks.vx, start.disks.vy);
    }
    const State end = test::run(s, start);
    EXPECT_EQ(end.counters.collisions, 1U);
    EXPECT_EQ(along_x ? end.disks.vx[0] : end.disks.vy[0], 1.0);
    EXPECT_EQ(along_x ? end.disks.vx[1] : end.disks.vy[1], -1.0);
    EXPECT_NEAR(along_x ? end.disks.x[0] : end.disks.y[0], 2.0, 1e-13);
    Disks disks = start.disks;
    for (int k = 0; k < 50; ++k) test::original::frame(disks, s);
    EXPECT_NE(along_x ? disks.vx[0] : disks.vy[0], 1.0);
  }
}

// A disk at rest on the floor stays there, with dissipating walls and with elastic ones.
TEST_P(Faults, F11_RestingDiskNeitherSinksNorGains) {
  for (const double wall_restitution : {0.5, 1.0}) {
    Scene s = scene(10.0, 0.01, 20.0);
    s.physics.gravity = 0.5;
    s.box.restitutions.fill(wall_restitution);
    const State start = test::state_of(s, {{5.0, 1.0, 0.0, 0.0, 1.0, 1.0}});
    const double energy = energy_of(start.disks, 0.5).total();
    const Holds rests = [&](const Disks& d) {
      return wall_overlap(d, s.box) <= 0.01 && energy_of(d, 0.5).total() <= energy * (1.0 + 1e-9);
    };
    EXPECT_TRUE(always(s, start, rests)) << wall_restitution;
    EXPECT_TRUE(wall_restitution == 1.0 || !always_in_original(s, start, rests));
  }
}

// A ball that falls on an elastic floor returns to its height any number of times, at whatever time in the step it
// hits.
TEST_P(Faults, F11_BouncingDiskKeepsItsEnergy) {
  Scene s = scene(10.0, 0.013, 60.0);
  s.physics.gravity = 0.5;
  const State start = test::state_of(s, {{5.0, 4.3, 0.2, 0.0, 1.0, 1.0}});
  const double energy = energy_of(start.disks, 0.5).total();
  const Holds keeps = [&](const Disks& d) {
    return wall_overlap(d, s.box) <= 1e-12 && std::abs(energy_of(d, 0.5).total() / energy - 1.0) <= 1e-12;
  };
  EXPECT_TRUE(always(s, start, keeps));
  EXPECT_FALSE(always_in_original(s, start, keeps));
}

// In a periodic box of width W the centre is always in [0, W), and every step moves it by v dt.
TEST_P(Faults, F12_WrapsByTheCentre) {
  Scene s = scene(10.0, 0.05, 30.0);
  test::set_sides(s.box, SideKind::periodic, SideKind::periodic);
  const State start = test::state_of(s, {{5.0, 5.0, 1.0, -0.7, 1.0, 1.0}});
  const Holds inside = [](const Disks& d) { return d.x[0] >= 0.0 && d.x[0] < 10.0 && d.y[0] >= 0.0 && d.y[0] < 10.0; };
  EXPECT_TRUE(always(s, start, inside));
  EXPECT_FALSE(always_in_original(s, start, inside));
  const State end = test::run(s, start);
  EXPECT_NEAR(end.disks.x[0], 5.0, 1e-12);
  EXPECT_NEAR(end.disks.y[0], 4.0, 1e-12);
}

// The left (upper) corners of the large disk are exactly at x = 0 (y = H), where the original finds no cell.
TEST_P(Faults, F13_CornersOnTheEdges) {
  const Scene s = scene(100.0, 0.05, 1.0);
  expect_seen_in_first_step(s,
                            test::state_of(s, {{10.5, 50.0, 0.0, 0.0, 10.5, 9.0}, {5.0, 60.12, 0.0, -1.0, 1.0, 1.0}}));
  expect_seen_in_first_step(s,
                            test::state_of(s, {{50.0, 89.5, 0.0, 0.0, 10.5, 9.0}, {60.12, 95.0, -1.0, 0.0, 1.0, 1.0}}));
}

// Two disks that are both in two cells collide once.
TEST_P(Faults, F14_PairInTwoSharedCells) {
  const Scene s = scene(100.0, 0.05, 1.0);
  const State start = test::state_of(s, {{19.5, 20.0, 1.0, 0.0, 1.0, 1.0}, {21.51, 20.0, -1.0, 0.0, 1.0, 1.0}});
  const Holds turned = [](const Disks& d) { return d.vx[0] == -1.0 && d.vx[1] == 1.0; };
  Disks drifted = start.disks;
  test::original::move(drifted, s.run.dt, 0.0);
  EXPECT_EQ(test::original::pairs(drifted, s.box).size(), 2U);
  EXPECT_EQ(find_touching_pairs(drifted, s.box).size(), 1U);
  EXPECT_TRUE(always(s, start, turned));
  EXPECT_EQ(test::run(s, start).counters.collisions, 1U);
  Options options;
  options.copies = false;
  EXPECT_FALSE(always_in_original(s, start, turned, options));
}

// (24): v = u / dt is drawn anew in each step, so the kinetic energy fluctuates about N m 2 D / dt (tolerance: 4
// standard errors of 2 N squared deviates); with accumulate = true, as in the original, it grows in every step.
TEST_P(Faults, F15_BrownianEnergyDoesNotGrow) {
  constexpr int n = 100;
  Scene s = scene(100.0, 0.01, 1.0);
  test::set_sides(s.box, SideKind::periodic, SideKind::periodic);
  s.physics.diffusion = 0.1;
  std::vector<Disk> list;
  for (int k = 0; k < n; ++k) {
    const Vec2 p = test::cell_centre(k, 10, 10.0);
    list.push_back({p.x, p.y, 0.0, 0.0, 1.0, 1.0});
  }
  const State start = test::state_of(s, list);
  const double expected = n * 2.0 * s.physics.diffusion / s.run.dt;
  const Holds steady = [&](const Disks& d) {
    return std::abs(energy_of(d, 0.0).kinetic / expected - 1.0) <= 4.0 * std::sqrt(2.0 / (2.0 * n));
  };
  EXPECT_TRUE(always(s, start, steady));
  s.physics.accumulate = true;
  EXPECT_FALSE(always(s, start, steady));
  EXPECT_GT(energy_of(test::run(s, start).disks, 0.0).kinetic, 50.0 * expected);
}

}  // namespace
}  // namespace carom
