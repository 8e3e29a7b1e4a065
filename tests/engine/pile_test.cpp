// Small piles: a ball at rest, a column, a pyramid. Disks at rest stay at rest, however their support is computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/measure/invariants.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

Scene pile_scene(double e, double dt, double t_end) {
  Scene scene = test::scene_of(Method::pairwise, 20.0, 40.0, dt, t_end);
  scene.physics.gravity = 0.5;
  scene.physics.restitution = e;
  scene.box.restitutions.fill(e);
  return scene;
}

struct Seen {
  double overlap = 0.0, below = 0.0, gained = -1.0, kinetic = 0.0;
  State end;
};

Seen watch(const Scene& scene, const State& start) {
  Seen seen;
  const double g = scene.physics.gravity.down;
  const double energy = energy_of(start.disks, g).total();
  seen.end = test::run(scene, start, [&](const Engine& engine) {
    const Disks& d = engine.state().disks;
    seen.overlap = std::max(seen.overlap, max_overlap(d, scene.box));
    seen.below = std::max(seen.below, wall_overlap(d, scene.box));
    seen.gained = std::max(seen.gained, energy_of(d, g).total() / energy - 1.0);
  });
  seen.kinetic = energy_of(seen.end.disks, g).kinetic / energy;
  return seen;
}

// The bounds for a settled pile are those of pile_validation.cpp.
void expect_bounds(const Seen& seen) {
  EXPECT_LE(seen.overlap, 0.02);
  EXPECT_LE(seen.below, 0.01);
  EXPECT_LE(seen.gained, 1e-9);
  EXPECT_LT(seen.kinetic, 1e-6);
}

// A ball at rest on the floor stays there, and the floor bears m g.
TEST(Pile, BallAtRest) {
  const Scene scene = pile_scene(0.5, 0.005, 10.0);
  const Seen seen = watch(scene, test::state_of(scene, {{10.0, 1.0, 0.0, 0.0, 1.0, 3.0}}));
  expect_bounds(seen);
  EXPECT_NEAR(seen.end.disks.y[0], 1.0, 2.001 * 0.5 * 0.005 * 0.005);
  EXPECT_EQ(seen.end.disks.x[0], 10.0);
  ASSERT_EQ(seen.end.loads.size(), 1U);
  EXPECT_NEAR(seen.end.loads[0].force, 3.0 * 0.5, 1e-9);
}

std::vector<Disk> column(std::size_t n, double gap) {
  std::vector<Disk> list;
  for (std::size_t k = 0; k < n; ++k) {
    list.push_back(
        {10.0, 1.0 + gap + static_cast<double>(k) * (2.0 + gap), 0.0, 0.0, 1.0, 1.0 + static_cast<double>(k % 3)});
  }
  return list;
}

// Ten disks one on another, of different masses: each contact bears the weight above it.
TEST(Pile, ColumnOfTenBearsItsWeight) {
  const Scene scene = pile_scene(0.5, 0.005, 20.0);
  const std::vector<Disk> list = column(10, 0.0);
  const Seen seen = watch(scene, test::state_of(scene, list));
  expect_bounds(seen);
  EXPECT_EQ(seen.end.loads.size(), 10U);
  double weight = 0.0;
  for (std::size_t k = 10; k-- > 0;) {
    weight += 0.5 * list[k].mass;
    // The contact of disk k with what is below it: the floor for disk 0, otherwise disk k - 1.
    const auto load = std::find_if(seen.end.loads.begin(), seen.end.loads.end(), [&](const ContactLoad& l) {
      return k == 0 ? l.id1 == 0 && l.id2 != 1 : l.id1 == k - 1 && l.id2 == k;
    });
    ASSERT_NE(load, seen.end.loads.end());
    EXPECT_NEAR(load->force / weight, 1.0, 1e-2);
    EXPECT_NEAR(seen.end.disks.y[k], list[k].y, 0.02 * 2.0 * static_cast<double>(k + 1));
    EXPECT_EQ(seen.end.disks.x[k], 10.0);
  }
}

// A pile at rest has no collisions, but its loads have a pressure: the sum of load times distance, over twice the area.
TEST(Pile, PressureOfAColumnIsThatOfItsLoads) {
  const std::vector<Disk> list = column(10, 0.0);
  const auto counters_at = [&](double time) {
    const Scene scene = pile_scene(0.5, 0.005, time);
    return watch(scene, test::state_of(scene, list)).end.counters;
  };
  const Counters before = counters_at(10.0), after = counters_at(20.0);
  EXPECT_EQ(after.collisions, before.collisions);
  double above = 0.0, loads = 0.0;
  for (std::size_t k = 10; k-- > 1;) {
    above += 0.5 * list[k].mass;
    loads += above * 2.0;
  }
  const double pressure = carom::pressure({}, after.virial - before.virial, 10.0, pile_scene(0.5, 0.005, 1.0).box);
  EXPECT_NEAR(pressure / (loads / (2.0 * 20.0 * 40.0)), 1.0, 2e-3);
}

// The last step of a run may be shorter than the others. It keeps the overlaps that contacts have by then; with those
// of its own length it would push the whole column up.
TEST(Pile, AShorterLastStepMovesNothing) {
  const auto heights_at = [&](double time) {
    const Scene scene = pile_scene(0.5, 0.005, time);
    return watch(scene, test::state_of(scene, column(10, 0.5))).end.disks.y;
  };
  const std::vector<double> before = heights_at(60.0), after = heights_at(60.001);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-8) << k;
}

// The same disks, dropped with gaps, come to rest as that column.
TEST(Pile, ColumnFallsAndStands) {
  for (const double e : {0.0, 0.5, 0.8}) {
    const Scene scene = pile_scene(e, 0.005, 60.0);
    const Seen seen = watch(scene, test::state_of(scene, column(10, 0.5)));
    expect_bounds(seen);
    for (std::size_t k = 0; k < 10; ++k) {
      EXPECT_NEAR(seen.end.disks.y[k], 1.0 + 2.0 * static_cast<double>(k), 0.01 * static_cast<double>(k + 1)) << e;
    }
  }
}

// Four disks from wall to wall and three in their hollows: they stay at rest, with the right load on the floor.
TEST(Pile, TwoRowsBetweenWalls) {
  Scene scene = pile_scene(0.5, 0.005, 20.0);
  scene.box.width = 8.0;
  std::vector<Disk> list;
  for (int k = 0; k < 4; ++k) list.push_back({1.0 + 2.0 * k, 1.0, 0.0, 0.0, 1.0, 1.0});
  for (int k = 0; k < 3; ++k) list.push_back({2.0 + 2.0 * k, 1.0 + std::sqrt(3.0), 0.0, 0.0, 1.0, 1.0});
  const Seen seen = watch(scene, test::state_of(scene, list));
  expect_bounds(seen);
  double floor = 0.0;
  for (const ContactLoad& load : seen.end.loads) {
    if (load.id2 == 0xfffffff0U + static_cast<DiskId>(Side::bottom)) floor += load.force;
  }
  EXPECT_NEAR(floor / (7.0 * 0.5), 1.0, 1e-2);
}

// A settling scene that is empty from the start: steps without disks, contacts or velocities.
TEST(Pile, OfNoDisksIsNone) {
  const Scene scene = pile_scene(0.5, 0.01, 1.0);
  const State none = test::state_of(scene, {});
  for (const int threads : {1, 3}) {
    const auto engine = make_parallel_engine(scene, none, {threads, 1});
    for (int step = 0; step < 3; ++step) engine->step();
    EXPECT_EQ(engine->state().disks.size(), 0U);
    EXPECT_TRUE(engine->state().loads.empty());
    EXPECT_EQ(engine->state().counters.wall_collisions, 0U);
  }
}

// If the force of a load is too small for a double, since the step is long and the impulse tiny, it counts as no load.
// The engine once pushed that disk off the side as one that bears load, and the reference as one that does not.
TEST(Pile, LoadWhoseForceVanishesIsNone) {
  Scene scene = pile_scene(0.5, 4.0, 8.0);
  scene.physics.gravity = 1e-6;
  const double slow = std::numeric_limits<double>::denorm_min();
  const State start = test::state_of(scene, {{1.0 - 1e-4, 1.0, -slow, 0.0, 1.0, 1.0}});
  const auto reference = make_reference_engine(scene, start);
  const auto engine = make_parallel_engine(scene, start, {1, 1});
  for (int step = 0; step < 2; ++step) {
    reference->step();
    engine->step();
    EXPECT_EQ(engine->state().disks.x[0], reference->state().disks.x[0]);
    EXPECT_EQ(engine->state().disks.x[0], 1.0);
    for (const Engine* either : {reference.get(), engine.get()}) {
      ASSERT_EQ(either->state().loads.size(), 1U);
      EXPECT_EQ(either->state().loads[0].id2, 0xfffffff0U + static_cast<DiskId>(Side::bottom));
    }
  }
}

}  // namespace
}  // namespace carom
