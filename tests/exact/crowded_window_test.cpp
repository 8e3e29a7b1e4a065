// Windows of the exact method with too many events: each of them ends, both engines give the same result, and a run
// that can be stopped stops within a window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/base/check.hpp"
#include "core/step/window_length.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom::exact_tests {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// The hash, time and counts at the end, or the error that ended the run and the hash of the state kept.
std::string outcome_of(Engine& engine, const Scene& scene) {
  std::string end = "done";
  try {
    run_to_end(engine, scene);
  } catch (const PhysicsError& error) {
    end = error.what();
  }
  const State& s = engine.state();
  return end + " | " + hash_text(state_hash(s.disks)) + " t " + std::to_string(s.time) + " windows " +
         std::to_string(s.counters.steps) + " collisions " + std::to_string(s.counters.collisions) + " walls " +
         std::to_string(s.counters.wall_collisions);
}

// Compares both engines, with regions and without; returns the outcome of the reference.
std::string outcome(const Scene& scene, const State& initial) {
  const std::string plain = outcome_of(*make_reference_exact(scene, initial), scene);
  EXPECT_EQ(outcome_of(*make_parallel_engine(scene, initial, {1}), scene), plain);
  EXPECT_EQ(outcome_of(*make_parallel_engine(scene, initial, {3, 1024}), scene), plain) << "tiles of eight disks";
  return plain;
}

// A light disk at rest between the left wall and a heavy disk that comes in.
State light_and_heavy(double ratio) {
  return state_of({{5, 10, 0, 0, 1, ratio, 0}, {20, 10, -1, 0, 1, 1.0, 0}});
}

Scene burst_scene() {
  Domain box;
  box.width = 40.0;
  box.height = 20.0;
  return plain_scene(box, 30.0);
}

// Bounces get lower and lower, and both engines must stop at the same one.
TEST(CrowdedWindow, BallsThatComeToRestStopBothEnginesAtTheSameBounce) {
  const std::string balls =
      "[[disks]]\ncount = 2\npositions = [[5, 5], [12, 8]]\nvelocities = [[0.125, 0], [0, 0]]\nradius = 0.5\nmass = "
      "1\n";
  const std::string shelf = "[[walls]]\nfrom = [1, 2]\nto = [19, 2]\n";
  for (const auto& [below, tables] :
       {std::pair{"the bottom wall", balls}, std::pair{"the wall walls.0", balls + shelf}}) {
    const Scene scene = make_scene({20, 20, "wall_restitution = 0.5", "gravity = 1.0", tables, 100, ""});
    EXPECT_THAT(outcome(scene, initial_state(scene)),
                AllOf(HasSubstr("has more and more collisions in less and less time"),
                      HasSubstr(std::string("with ") + below)));
  }
}

// Each disk has hundreds of dissipating contacts, some of them at the ends of windows. They are far apart in time, and
// the count of one window must not be continued in the next.
TEST(CrowdedWindow, ContactsOfManyWindowsAreNoBurst) {
  const Scene scene = make_scene({6, 6, "wall", "restitution = 0.9999", random_disks(8, equal_disks), 600, ""});
  EXPECT_THAT(outcome(scene, initial_state(scene)), testing::StartsWith("done"));
}

// There are pi sqrt(M / m) collisions, as in the case of 1 : 100^n that counts the digits of pi; half of them are
// between the disks.
TEST(LongCrowdedWindow, FiniteBurstsAreCountedToTheEndByBothEngines) {
  for (const double ratio : {1e-8, 1e-10, 1e-12}) {
    const Scene scene = burst_scene();
    const auto reference = make_reference_exact(scene, light_and_heavy(ratio));
    const auto parallel = make_parallel_engine(scene, light_and_heavy(ratio), {1});
    const std::string plain = outcome_of(*reference, scene);
    EXPECT_EQ(outcome_of(*parallel, scene), plain);
    EXPECT_THAT(plain, HasSubstr("done"));
    const Counters& c = reference->state().counters;
    EXPECT_NEAR(static_cast<double>(c.collisions), 0.5 * std::numbers::pi / std::sqrt(ratio), 2.0) << ratio;
    EXPECT_NEAR(energy_of(reference->state().disks, 0.0).kinetic, 0.5, 1e-9) << ratio;
  }
}

// The same burst, with moving walls at the other end of the box that take no part in it.
TEST(LongCrowdedWindow, AFiniteBurstGoesOnWhereAWallMovesThatHasNoPartInIt) {
  const std::string burst =
      "[physics]\n[[disks]]\ncount = 2\npositions = [[5, 10], [20, 10]]\nvelocities = [[0, 0], [-1, 0]]\nradius = 1\n"
      "mass = [1e-10, 1]\n[run]\nt_end = 20.0\n";
  const std::string box = "[box]\nwidth = 40.0\nheight = 20.0\n";
  const std::string shaker = "motion = { vibrate = [0.1, 0.0], period = 3.0 }";
  for (const std::string& walls :
       {"right = { place = 39.0, " + shaker + " }\n", "[[walls]]\nfrom = [39, 2]\nto = [39, 18]\n" + shaker + "\n"}) {
    const Scene scene = parse_scene(box + walls + burst, "burst", "");
    const State initial = initial_state(scene);
    const auto reference = make_reference_exact(scene, initial);
    const std::string plain = outcome_of(*reference, scene);
    EXPECT_THAT(plain, HasSubstr("done"));
    EXPECT_EQ(outcome_of(*make_parallel_engine(scene, initial, {1}), scene), plain);
    EXPECT_EQ(reference->state().counters.collisions, 157079U);
  }
}

// The message for a disk that comes to rest on a plate vibrating as a sine must not say that it lacks room.
TEST(LongCrowdedWindow, ComingToRestOnASineIsCalledByItsName) {
  const std::string text =
      "[box]\nwidth = 10.0\nheight = 10.0\nwall_restitution = 0.5\n"
      "bottom = { place = 0.5, motion = { vibrate = [0, 0.3], period = 5.0, shape = \"sine\" } }\n"
      "[physics]\ngravity = 1.0\n[[disks]]\ncount = 1\npositions = [[3, 2]]\nradius = 0.5\nmass = 1\n"
      "[run]\nt_end = 20.0\n";
  const Scene scene = parse_scene(text, "plate", "");
  EXPECT_THAT(outcome(scene, initial_state(scene)),
              AllOf(HasSubstr("almost stands still"), HasSubstr("come to rest on a wall (inelastic collapse)"),
                    HasSubstr("physics.collapse = {"), HasSubstr("or use run.method = \"pairwise\"")));
}

// The same burst in a box whose walls lose energy but take no part in it: the light disk bounces between two heavy
// ones.
TEST(LongCrowdedWindow, AnElasticBurstIsNoCollapseWhereOtherContactsDissipate) {
  Scene scene = burst_scene();
  scene.box.restitutions.fill(0.5);
  scene.run.t_end = 20.0;
  const State initial = state_of({{3, 10, 1, 0, 1, 1.0, 0}, {20, 10, 0, 0, 1, 1e-10, 0}, {36, 10, -1, 0, 1, 1.0, 0}});
  EXPECT_THAT(outcome(scene, initial), HasSubstr("done"));
}

// A burst in the corner of a gas, with regions: they are given up to find the event at which the count became too
// large.
TEST(LongCrowdedWindow, ABurstAmongOthersInTiles) {
  const Scene scene =
      make_scene({30, 30, "wall", "",
                  "[[disks]]\ncount = 2\npositions = [[0.3, 15], [3.6, 15]]\nvelocities = [[0, 0], [-1, 0]]\n"
                  "radius = [0.25, 3]\nmass = [1e-2, 1e8]\n"
                  "[[disks]]\ncount = 90\npositions = \"random\"\nradius = 0.6\nmass = 1\n"
                  "velocities = { maxwell = 1.0 }\n",
                  4.0, ""});
  const State initial = initial_state(scene);
  const auto reference = make_reference_exact(scene, initial);
  const std::string plain = outcome_of(*reference, scene);
  EXPECT_GT(reference->state().counters.wall_collisions, 2U * most_paths_of_disk);
  for (const int threads : test::thread_counts) {
    EXPECT_EQ(outcome_of(*make_parallel_engine(scene, initial, {threads, 1024}), scene), plain) << threads;
  }
}

TEST(CrowdedWindow, NoWindowHoldsMoreThanItsBound) {
  const Scene scene = burst_scene();
  const auto engine = make_parallel_engine(scene, light_and_heavy(1e-10), {1});
  Count before = 0;
  Count most = 0;
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    const Counters& c = engine->state().counters;
    most = std::max(most, c.collisions + c.wall_collisions - before);
    before = c.collisions + c.wall_collisions;
  }
  EXPECT_LE(most, Count{most_paths_of_disk});
  EXPECT_GT(most, Count{most_paths_of_disk} / 4);
}

TEST(CrowdedWindow, OneDiskThatFillsTheBox) {
  Domain box;
  box.width = box.height = 2.0;
  EXPECT_THAT(outcome(plain_scene(box, 1.0), state_of({{1, 1, 1, 0, 1, 1, 0}})),
              AllOf(HasSubstr("time stands still at t = 0"), HasSubstr("no room to move"), Not(HasSubstr("collapse"))));
}

TEST(CrowdedWindow, TouchingDisksThatFillTheBox) {
  for (const double e : {1.0, 0.9}) {
    Scene scene = make_scene({8, 8, "wall", "restitution = " + std::to_string(e),
                              "[[disks]]\ncount = 16\npositions = \"square\"\nradius = 1\nmass = 1\n"
                              "velocities = { maxwell = 1.0 }\n",
                              1.0, ""});
    const std::string end = outcome(scene, initial_state(scene));
    if (e == 1.0) {
      EXPECT_THAT(end, AllOf(HasSubstr("time stands still"), Not(HasSubstr("collapse"))));
    } else {
      EXPECT_THAT(end, HasSubstr("inelastic collapse"));
    }
  }
}

// The gaps are of the order of the last bit, so each event advances time by 1e-16.
TEST(LongCrowdedWindow, HardlyAnyRoom) {
  Domain box;
  box.width = box.height = std::nextafter(2.0, 3.0);
  EXPECT_THAT(outcome(plain_scene(box, 1.0), state_of({{1, 1, 1, 0.3, 1, 1, 0}})),
              AllOf(HasSubstr("stands still"), HasSubstr("room to move"), Not(HasSubstr("collapse"))));
}

// If contacts may lose energy it may be a collapse as well, and the message says both.
TEST(LongCrowdedWindow, HardlyAnyRoomWhereDisksMayComeToRest) {
  Domain box;
  box.width = box.height = std::nextafter(2.0, 3.0);
  Scene scene = plain_scene(box, 1.0);
  scene.physics.restitution = 0.5;
  EXPECT_THAT(outcome(scene, state_of({{1, 1, 1, 0.3, 1, 1, 0}})),
              AllOf(HasSubstr("stands still"), HasSubstr("come to rest (inelastic collapse), or have hardly any room"),
                    HasSubstr("physics.collapse = {")));
}

TEST(CrowdedWindow, AtRestOnAnElasticFloorIsNotCalledCollapse) {
  Domain box;
  box.width = box.height = 10.0;
  EXPECT_THAT(outcome(plain_scene(box, 1.0, 1.0), state_of({{5, 1, 0, 0, 1, 1, 0}})),
              AllOf(HasSubstr("time stands still at t = 0"), HasSubstr("the bottom wall"), Not(HasSubstr("collapse"))));
}

// The same for a disk on a moving floor, at rest in the floor's frame or hopping so little that it would hop for ever:
// the message must not say that room is lacking.
TEST(CrowdedWindow, AtRestOnAFloorThatMovesIsCalledByItsName) {
  const auto resting = [](const std::string& y) {
    const std::string text =
        "[box]\nwidth = 10.0\nheight = 10.0\nbottom = { motion = { velocity = [0.0, 0.01] } }\n"
        "[physics]\ngravity = 1.0\n[[disks]]\ncount = 1\npositions = [[3.0, " +
        y + "]]\nvelocities = [[0.0, 0.01]]\nradius = 0.25\nmass = 1\n[run]\nt_end = 20.0\n";
    const Scene scene = parse_scene(text, "lift", "");
    return outcome(scene, initial_state(scene));
  };
  EXPECT_THAT(resting("0.25"), AllOf(HasSubstr("time stands still at t = 0"), HasSubstr("they rest on each other, or"),
                                     HasSubstr("use run.method = \"pairwise\""), Not(HasSubstr("collapse"))));
  EXPECT_THAT(resting("0.250000000001"),
              AllOf(HasSubstr("time almost stands still"), HasSubstr("disks rest on a wall, or"),
                    HasSubstr("use run.method = \"pairwise\""), Not(HasSubstr("collapse"))));
}

TEST(LongCrowdedWindow, MassesWhoseSumIsNotANumber) {
  Domain box;
  box.width = box.height = 20.0;
  const State initial = state_of({{5, 10, 1, 0, 1, 1.2e308, 0}, {15, 10, -1, 0, 1, 1.1e308, 0}});
  EXPECT_THAT(outcome(plain_scene(box, 20.0), initial), HasSubstr("time stands still"));
}

Scene resting_pile(double contact_time) {
  Scene scene = make_scene({6, 10, "wall", "gravity = 10.0\nrestitution = 0.5\n",
                            "[[disks]]\ncount = 6\npositions = [[1, 0.5], [2, 0.5], [3, 0.5], [4, 0.5], [1.5, 1.5], "
                            "[2.5, 1.5]]\nradius = 0.5\nmass = 1\n",
                            20.0, ""});
  scene.box.restitutions.fill(0.5);
  scene.physics.collapse_contact_time = contact_time;
  return scene;
}

// The run would take years, with a dozen collisions per disk in each contact time: both engines say so after the same
// window.
TEST(LongCrowdedWindow, APileWithATinyContactTimeSaysThatTimeHardlyAdvances) {
  const Scene scene = resting_pile(1e-10);
  EXPECT_THAT(outcome(scene, initial_state(scene)),
              AllOf(HasSubstr("time almost stands still at t = "), HasSubstr("contact_time is too short"),
                    HasSubstr("pairwise"), Not(HasSubstr("collapse at"))));
}

TEST(CrowdedWindow, AContactTimeBelowTheResolutionOfTime) {
  Scene scene = resting_pile(1e-24);
  State initial = initial_state(scene);
  initial.time = 1.0;
  EXPECT_THAT(outcome(scene, initial), AllOf(HasSubstr("stands still"), HasSubstr("contact_time is too short")));
}

// A step that is given up leaves the state as it was at its start, and the next step has the bits that it would have
// had.
TEST(LongCrowdedWindow, AStepGivenUpChangesNoBit) {
  Scene scene = burst_scene();
  for (const bool parallel : {false, true}) {
    const auto make = [&] {
      return parallel ? make_parallel_engine(scene, light_and_heavy(1e-9), {1})
                      : make_reference_exact(scene, light_and_heavy(1e-9));
    };
    const auto whole = make();
    const std::string expected = outcome_of(*whole, scene);
    const auto engine = make();
    int questions = 0;
    int next = 3;
    bool stop = false;
    Count given_up = 0;
    engine->set_watch([&] {
      stop = ++questions == next;
      if (stop) next += next / 2;
      return !stop;
    });
    while (engine->state().time < scene.run.t_end) {
      const State before = engine->state();
      stop = false;
      engine->step();
      if (!stop) continue;
      ++given_up;
      EXPECT_EQ(engine->state().time, before.time);
      EXPECT_EQ(state_hash(engine->state().disks), state_hash(before.disks));
      EXPECT_EQ(engine->state().counters.steps, before.counters.steps);
    }
    EXPECT_EQ(outcome_of(*engine, scene), expected);
    EXPECT_GT(given_up, 0U) << (parallel ? "parallel" : "reference");
  }
}

}  // namespace
}  // namespace carom::exact_tests
