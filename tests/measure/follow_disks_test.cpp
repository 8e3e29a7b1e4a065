// The times at which disks are looked at on their way around a periodic box, if speeds change between two looks.
#include "core/measure/follow_disks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/disks/fastest_speed.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/scripted_engine.hpp"

namespace carom {
namespace {

using ::testing::EndsWith;

// A hot floor sends a slow disk up, often around the box, and a cold ceiling takes its speed away, within windows whose
// length suits slow disks.
Scene between_hot_and_cold() {
  Scene scene = test::scene_of(Method::exact, 3.0, 20.0, 0.0, 400.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::wall);
  scene.box.temperatures = {0.0, 0.0, 100.0, 1e-2};
  return scene;
}

State two_slow_disks(const Scene& scene) {
  return test::state_of(scene, {{0.5, 1.0, 0.01, -0.1, 0.2, 1.0}, {2.0, 8.0, 0.02, -0.05, 0.2, 1.0}});
}

struct TwoTallies {
  DisplacementTally followed, often;
};

// The displacement with looks when they are due, and with a look in each thousandth of a unit of time.
TwoTallies follow_twice(Engine& engine, const Scene& scene) {
  TwoTallies tallies;
  for (DisplacementTally* t : {&tallies.followed, &tallies.often}) {
    begin_displacement(*t, engine.state().disks, scene.box, 0.0);
  }
  while (engine.state().time < scene.run.t_end) {
    const double begin = engine.state().time;
    engine.step();
    const double end = engine.state().time;
    Disks there;
    for (double t = begin; t < end; t += 1e-3) look_at(tallies.often, (engine.disks_at(t, there), there), scene.box, t);
    look_at(tallies.often, engine.state().disks, scene.box, end);
    if (follow_disks(tallies.followed, engine, scene, end)) {
      look_at(tallies.followed, engine.state().disks, scene.box, end);
    }
  }
  look_at(tallies.followed, engine.state().disks, scene.box, scene.run.t_end);
  return tallies;
}

// The mean of (x - x_0)^2 + (y - y_0)^2 with x = place + width * rounds, in which no round may be missed.
TEST(FollowDisks, SpeedsThatADiskHasOnlyWithinAWindowCount) {
  const Scene scene = between_hot_and_cold();
  const auto expect_followed = [&](std::unique_ptr<Engine> engine, const char* which) {
    const TwoTallies tallies = follow_twice(*engine, scene);
    const Disks& disks = engine->state().disks;
    const double often = mean_square_displacement(tallies.often, disks, scene.box).value;
    EXPECT_EQ(mean_square_displacement(tallies.followed, disks, scene.box).value, often) << which;
    EXPECT_GT(often, 5.0 * 5.0 * 9.0) << "the disk must go more than five times around the box";
    EXPECT_LT(engine->progress().counters.steps, 40U) << "windows must be long";
    EXPECT_EQ(tallies.followed.doubtful, 0U) << which;
    EXPECT_EQ(tallies.often.doubtful, 0U) << which;
  };
  expect_followed(make_reference_engine(scene, two_slow_disks(scene)), "reference");
  expect_followed(make_parallel_engine(scene, two_slow_disks(scene), {1}), "one thread");
  expect_followed(make_parallel_engine(scene, two_slow_disks(scene), {2}), "two threads");
}

// Both engines give the same largest speed; that of a window is at least those at its ends.
TEST(FollowDisks, TheLargestSpeedWithinAWindowIsThatOfItsPaths) {
  const Scene scene = between_hot_and_cold();
  const auto reference = make_reference_engine(scene, two_slow_disks(scene));
  const auto parallel = make_parallel_engine(scene, two_slow_disks(scene), {1});
  double most = 0.0, at_ends = 0.0;
  while (reference->state().time < scene.run.t_end) {
    reference->step();
    parallel->step();
    const double end = fastest_speed(reference->state().disks);
    EXPECT_EQ(std::max(end, reference->fastest_within()), std::max(end, parallel->fastest_within()));
    most = std::max(most, reference->fastest_within());
    at_ends = std::max(at_ends, end);
  }
  EXPECT_GT(most, at_ends);
}

// The same if threads have parts of the box, with ghosts from other parts.
TEST(LongFollowDisks, TheLargestSpeedWithinAWindowIsThatOfAllParts) {
  Scene scene = test::scene_of(Method::exact, 120.0, 120.0, 0.0, 3.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  test::Draws draws(7);
  const State start = test::state_of(scene, test::random_disks(draws, scene.box, 6000, {0.3, 0.5}));
  const auto reference = make_reference_engine(scene, start);
  const auto one = make_parallel_engine(scene, start, {1}), two = make_parallel_engine(scene, start, {2});
  while (reference->state().time < scene.run.t_end) {
    for (Engine* const engine : {reference.get(), one.get(), two.get()}) engine->step();
    const double end = fastest_speed(reference->state().disks);
    const double within = std::max(end, reference->fastest_within());
    EXPECT_EQ(std::max(end, one->fastest_within()), within);
    EXPECT_EQ(std::max(end, two->fastest_within()), within);
  }
}

// A disk that creeps along x for a hundred steps, until something hits it. Its engine knows no times within a step.
class CreepingDisk : public test::ScriptedEngine {
 public:
  CreepingDisk() { state_.disks = test::disks_of({{0.5, 2.0, 0.01, 0.0}}); }
  void step() override {
    state_.time += 1.0;
    const double speed = state_.time > 100.0 ? 1.0 : 0.01;
    const double x = state_.disks.x[0] + speed;
    state_.disks = test::disks_of({{x < 10.0 ? x : x - 10.0, 2.0, speed, 0.0}});
  }
};

// The disk has not had its new speed since the last look: it moves for 100 at 0.01, then for 20 at 1.
TEST(FollowDisks, ADiskThatIsHitAfterLongRestIsNoDoubt) {
  Scene scene = test::scene_of(Method::pairwise, 10.0, 10.0, 1.0, 120.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  CreepingDisk engine;
  DisplacementTally tally;
  begin_displacement(tally, engine.state().disks, scene.box, 0.0);
  while (engine.state().time < scene.run.t_end) {
    engine.step();
    const State& now = engine.state();
    if (follow_disks(tally, engine, scene, now.time)) look_at(tally, now.disks, scene.box, now.time);
  }
  look_at(tally, engine.state().disks, scene.box, 120.0);
  EXPECT_NEAR(mean_square_displacement(tally, engine.state().disks, scene.box).value, 21.0 * 21.0, 1e-9);
  EXPECT_EQ(tally.doubtful, 0U);
}

// In an exact run the advice cannot be a smaller dt.
TEST(FollowDisks, ADoubtSaysWhatHelps) {
  Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 1.0);
  const auto text = [&] { return doubt_text({}, scene, "trajectory", "its counts", "output.every"); };
  EXPECT_THAT(text(), EndsWith("its counts may be wrong from then on; use a smaller output.every"));
  scene.physics.diffusion = 1.0;
  EXPECT_THAT(text(), EndsWith("; use a smaller dt"));
  scene.physics.diffusion = 0.0;
  scene.run.method = Method::pairwise;
  EXPECT_THAT(text(), EndsWith("; use a smaller dt"));
}

}  // namespace
}  // namespace carom
