// The faults F1 and F2 of docs/original.md, which belong to the method `rollback`, are shown; and the guard that stops
// a stalled run.
#include "parallel/stepping/rollback.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/reference/reference_rollback.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/rollback_frame.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// n equal elastic disks at packing fraction 0.2 in a periodic box.
Scene gas_scene(Method method, int per_side, double dt, double t_end) {
  const double spacing = std::sqrt(std::numbers::pi / 4.0 / 0.2);  // the diameter is 1
  Scene scene = test::scene_of(method, per_side * spacing, per_side * spacing, dt, t_end);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  return scene;
}

State gas(const Scene& scene, int per_side) {
  test::Draws draws(5);
  std::vector<Disk> list;
  const double spacing = scene.box.width / per_side;
  for (int k = 0; k < per_side * per_side; ++k) {
    const Vec2 p = test::cell_centre(k, per_side, spacing);
    list.push_back({p.x, p.y, draws.in(-1.7, 1.7), draws.in(-1.7, 1.7), 0.5, 1.0});
  }
  return test::state_of(scene, list);
}

// F1: a frame advances time by dt minus the largest back-up time of all pairs. The mean advance, in units of dt, falls
// with N.
TEST(Rollback, F01_FramesAdvanceLessTheMoreDisksThereAre) {
  double advance[3] = {};
  const int per_side[3] = {4, 12, 36};
  for (int k = 0; k < 3; ++k) {
    const Scene scene = gas_scene(Method::rollback, per_side[k], 0.05, 2.0);
    const State end = test::run(scene, gas(scene, per_side[k]));
    advance[k] = scene.run.t_end / scene.run.dt / static_cast<double>(end.counters.steps);
    std::printf("N = %d: a frame advances time by %.3f dt\n", per_side[k] * per_side[k], advance[k]);
  }
  EXPECT_LT(advance[1], 0.9 * advance[0]);
  EXPECT_LT(advance[2], 0.9 * advance[1]);
}

// F2: pairs that have not yet met bounce at the first contact of all, so the collision rate is too high, and more so
// for longer steps. With the same step pairwise is much closer.
TEST(Rollback, F02_CollisionRateIsTooHigh) {
  const int per_side = 16;
  const auto collisions = [&](Method method, double dt) {
    const Scene scene = gas_scene(method, per_side, dt, 2.0);
    return static_cast<double>(test::run(scene, gas(scene, per_side)).counters.collisions);
  };
  const double right = collisions(Method::pairwise, 0.001);
  const double pairwise = collisions(Method::pairwise, 0.1);
  const double rollback = collisions(Method::rollback, 0.1);
  std::printf("collisions at dt = 0.1 over those at dt = 0.001: pairwise %.3f, rollback %.3f\n", pairwise / right,
              rollback / right);
  EXPECT_GT(rollback, right);
  EXPECT_GT(rollback / right - 1.0, 2.0 * std::abs(pairwise / right - 1.0));
}

// Two disks that meet nothing, with a kick of a thermostat at each quarter of the run.
Scene kicked_scene(Method method, double t_end, int steps) {
  Scene scene = test::scene_of(method, 50.0, 50.0, t_end / steps, t_end);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.physics.thermostat = {Thermostat::Kind::langevin, 1.0, 0.5, 0.25 * t_end};
  return scene;
}

const std::vector<Disk> two_free_disks = {{10.0, 10.0, 1.0, 0.0, 0.5, 1.0}, {40.0, 40.0, 0.0, 1.0, 0.5, 1.0}};

// By rounding the sum of the lengths of frames may lie below t_end. This must not add a frame, which would give a kick
// that is due at t_end.
TEST(Rollback, RoundingOfTimeAddsNoFrameAndNoKick) {
  for (const double t_end : {0.9, 1.1, 1.161473, 1.4456504310434455, 7.7}) {
    for (const int steps : {100, 512, 2048, 8192}) {
      const Scene scene = kicked_scene(Method::rollback, t_end, steps);
      const State end = test::run(scene, test::state_of(scene, two_free_disks));
      EXPECT_EQ(end.counters.steps, static_cast<Count>(steps)) << t_end;
      EXPECT_EQ(end.intervals, 4) << t_end << ", " << steps << " steps";
      EXPECT_EQ(end.time, t_end);
      const Scene stepped = kicked_scene(Method::pairwise, t_end, steps);
      const State other = test::run(stepped, test::state_of(stepped, two_free_disks));
      EXPECT_EQ(end.disks.vx, other.disks.vx) << t_end << ", " << steps << " steps";
    }
  }
}

// The same between two Brownian intervals.
TEST(Rollback, RoundingOfTimeAddsNoFrameToABrownianInterval) {
  for (const double dt : {0.01, 0.003, 0.0007}) {
    Scene scene = test::scene_of(Method::rollback, 50.0, 50.0, dt, 1000.0 * dt);
    test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
    scene.physics.diffusion = 0.01;
    const State end = test::run(scene, test::state_of(scene, two_free_disks));
    EXPECT_EQ(end.counters.steps, 1000) << dt;
    EXPECT_EQ(end.intervals, 1000) << dt;
  }
}

// The rest of an interval becomes a frame of its own if it is more than rounding.
TEST(Rollback, AFrameTakesInNoMoreThanRounding) {
  EXPECT_EQ(frame_length(0.1, 0.1 + 1e-14, 1.0), 0.1 + 1e-14);
  EXPECT_EQ(frame_length(0.1, 0.1 - 1e-14, 1.0), 0.1 - 1e-14);
  EXPECT_EQ(frame_length(0.1, 0.1 + 1e-9, 1.0), 0.1);
  EXPECT_EQ(frame_length(1e-13, 1.5e-13, 1.0), 1e-13);  // steps that are as short as rounding themselves
}

TEST(StallGuard, StopsARunWhoseTimeStandsStill) {
  Scene scene = test::scene_of(Method::rollback, 10.0, 10.0, 0.5, 10.0);
  State state = test::state_of(scene, {{5.0, 5.0, 0.0, 0.0, 1.0, 1.0}});
  state.time = 2.0;
  state.stall.since = state.time;
  for (int k = 0; k < 9999; ++k) {
    state.time += 0.49 / 10000;
    check_stall(state, scene);
  }
  try {
    check_stall(state, scene);
    FAIL() << "the guard did not stop the run";
  } catch (const PhysicsError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("rollback: time stands still at t = 2.4"), std::string::npos) << text;
    EXPECT_NE(text.find("0.97"), std::string::npos) << text;
    EXPECT_NE(text.find("1 disk;"), std::string::npos) << text;
    EXPECT_NE(text.find("run.method = \"pairwise\""), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

// A rough wall converts spin to speed: the next frame is split according to the disk's new speed, in both engines.
TEST(Rollback, ADiskThatARoughWallSetsGoingIsSeenToBeFast) {
  Scene scene = parse_scene(R"([box]
width = 20
height = 20
wall_roughness = { tangential_restitution = 0.5 }
[physics]
roughness = { tangential_restitution = 0.5 }
[[disks]]
count = 1
positions = [[5, 0.55]]
velocities = [[0, -1]]
spin = 40
radius = 0.5
mass = 1
[run]
method = "rollback"
dt = 0.1
t_end = 1
)",
                            "test", "");
  const auto reference = make_reference_rollback(scene, initial_state(scene));
  const auto parallel = make_parallel_rollback(scene, initial_state(scene), {1});
  for (int frame = 0; frame < 4; ++frame) {
    reference->step();
    parallel->step();
    EXPECT_EQ(parallel->state().time, reference->state().time) << frame;
    EXPECT_EQ(state_hash(parallel->state().disks), state_hash(reference->state().disks)) << frame;
  }
  EXPECT_LT(reference->state().time, 0.3) << "no frame was split";
}

// The same for a hot side and a moving side; and a ceiling sends a disk down faster than it came.
TEST(Rollback, ADiskThatASideMakesFastIsSeenToBeFast) {
  const auto runs_alike = [](const std::string& box, const std::string& physics, const std::string& disk) {
    const Scene scene = parse_scene("[box]\nwidth = 20\nheight = 20\n" + box + "[physics]\n" + physics +
                                        "[[disks]]\ncount = 1\nradius = 0.5\nmass = 1\n" + disk +
                                        "[run]\nmethod = \"rollback\"\ndt = 0.1\nt_end = 1\n",
                                    "test", "");
    const auto reference = make_reference_rollback(scene, initial_state(scene));
    const auto parallel = make_parallel_rollback(scene, initial_state(scene), {1});
    for (int frame = 0; frame < 6; ++frame) {
      reference->step();
      parallel->step();
      if (parallel->state().time != reference->state().time) return false;
      if (state_hash(parallel->state().disks) != state_hash(reference->state().disks)) return false;
    }
    return true;
  };
  const std::string near_left = "positions = [[0.55, 10]]\nvelocities = [[-1, 0]]\n";
  EXPECT_TRUE(runs_alike("left = { temperature = 400.0 }\n", "", near_left));
  EXPECT_TRUE(runs_alike("left = { motion = { velocity = [2.0, 0.0] } }\n", "", near_left));
  for (int k = 0; k < 100; ++k) {
    const double up = 0.02 * k;
    EXPECT_TRUE(runs_alike("", "gravity = 10.0\n",
                           "positions = [[10, 19.45]]\nvelocities = [[0, " + std::to_string(up) + "]]\n"))
        << up;
  }
}

// A wall sends one disk into another; only the next frame finds the overlap and separates them. Once no warning
// reported it.
TEST(Rollback, SeesWhereAWallSendsADiskIntoAnother) {
  const Scene scene = test::scene_of(Method::rollback, 10.0, 10.0, 1.0, 4.0);
  const State start = test::state_of(scene, {{1.05, 5.0, -0.45, 0.0, 1.0, 1.0}, {3.06, 5.0, 0.0, 0.0, 1.0, 1.0}});
  const auto reference = make_reference_rollback(scene, start);
  const auto parallel = make_parallel_rollback(scene, start, {1});
  Overlap deepest;
  while (reference->state().time < scene.run.t_end) {
    reference->step();
    parallel->step();
    deepest.raise_to(deepest_overlap(reference->state().disks, scene.box));
  }
  EXPECT_NEAR(deepest.size, 0.17, 1e-12) << "the centres are 1.66 apart after the first frame";
  for (Engine* const engine : {reference.get(), parallel.get()}) {
    const Overlap& told = engine->state().validity.disks.overlap;
    EXPECT_NEAR(told.size, deepest.size, 1e-12);
    EXPECT_EQ(told.id1, 0U);
    EXPECT_EQ(told.id2, 1U);
    EXPECT_EQ(engine->take_warnings().size(), 1U);
  }
}

TEST(StallGuard, LetsASlowRunGoOn) {
  Scene scene = test::scene_of(Method::rollback, 10.0, 10.0, 0.5, 10.0);
  State state = test::state_of(scene, {});
  for (int k = 0; k < 50000; ++k) {
    state.time += 0.51 / 10000;
    EXPECT_NO_THROW(check_stall(state, scene));
  }
}

}  // namespace
}  // namespace carom
