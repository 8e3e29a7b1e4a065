// Mean square displacement: across periodic sides, for any frequency of samples; free flight, Brownian motion, sinks.
#include "core/measure/displacement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/disks/state.hpp"
#include "core/measure/follow_disks.hpp"
#include "core/scene/scene.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/scripted_engine.hpp"

namespace carom {
namespace {

Scene periodic_scene(Method method, double dt, double t_end) {
  Scene scene = test::scene_of(method, 6.0, 4.0, dt, t_end);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  return scene;
}

// Disks in rows of their own, which all rise at the same speed, so that they never meet.
std::vector<Disk> rows(std::size_t n, double speed) {
  test::Draws draws(5);
  std::vector<Disk> list;
  for (std::size_t i = 0; i < n; ++i) {
    const double y = 4.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double radius = std::min(0.02, 0.8 / static_cast<double>(n));
    list.push_back({draws.in(0.0, 6.0), y, draws.in(-speed, speed), 0.3 * speed, radius, 1.0, 0});
  }
  return list;
}

double mean_square_speed(const std::vector<Disk>& list) {
  double sum = 0.0;
  for (const Disk& d : list) sum += d.vx * d.vx + d.vy * d.vy;
  return sum / static_cast<double>(list.size());
}

// The displacement at the end of a run that is followed step by step.
struct Followed {
  MeanSquare mean;
  Count doubtful = 0;
};
Followed follow(Engine& engine, const Scene& scene) {
  DisplacementTally tally;
  begin_displacement(tally, engine.state().disks, scene.box, engine.state().time);
  while (engine.state().time < scene.run.t_end) {
    engine.step();
    const State& now = engine.state();
    if (follow_disks(tally, engine, scene, now.time)) look_at(tally, now.disks, scene.box, now.time);
  }
  look_at(tally, engine.state().disks, scene.box, engine.state().time);
  return {mean_square_displacement(tally, engine.state().disks, scene.box), tally.doubtful};
}

// (v t)^2 to rounding, after up to thirty periods; in windows of exact such disks fly far at a time.
TEST(Displacement, FreeFlightGoesRoundTheBox) {
  for (const Method method : {Method::pairwise, Method::exact}) {
    for (const std::size_t n : {1U, 3U, 50U}) {
      const Scene scene = periodic_scene(method, 4e-3, 20.0);
      const std::vector<Disk> list = rows(n, 10.0);
      const auto engine = make_reference_engine(scene, test::state_of(scene, list));
      const Followed f = follow(*engine, scene);
      const double expected = mean_square_speed(list) * 20.0 * 20.0;
      EXPECT_NEAR(f.mean.value / expected, 1.0, 1e-9) << test::name_of(method) << ", " << n;
      EXPECT_EQ(f.mean.disks, n);
      EXPECT_EQ(f.doubtful, 0U);
    }
  }
}

// With so many disks speeds are only rarely looked at.
TEST(LongDisplacement, ManyDisksAreFollowedToo) {
  const Scene scene = periodic_scene(Method::exact, 0.0, 1.0);
  const std::vector<Disk> list = rows(5000, 10.0);
  const auto engine = make_parallel_engine(scene, test::state_of(scene, list), {2});
  const Followed f = follow(*engine, scene);
  EXPECT_NEAR(f.mean.value / mean_square_speed(list), 1.0, 1e-9);
  EXPECT_EQ(f.doubtful, 0U);
}

// Disks fall for ever from rest: by g t^2 / 2.
TEST(Displacement, FreeFallIsFollowedThoughItBeginsAtRest) {
  Scene scene = periodic_scene(Method::exact, 0.0, 20.0);
  scene.physics.gravity = 1.0;
  const auto engine = make_reference_engine(scene, test::state_of(scene, rows(1, 0.0)));
  const Followed f = follow(*engine, scene);
  EXPECT_NEAR(f.mean.value, 200.0 * 200.0, 1e-6);
  EXPECT_EQ(f.doubtful, 0U);
}

// A step in which disks cross the whole box, without samples in between, gives a warning instead of a wrong number.
TEST(Displacement, AStepTooLongIsADoubt) {
  Scene scene = periodic_scene(Method::pairwise, 1.0, 10.0);
  std::vector<Disk> list = rows(3, 10.0);
  for (Disk& d : list) d.radius = 0.5;
  const auto engine = make_reference_engine(scene, test::state_of(scene, list));
  EXPECT_GT(follow(*engine, scene).doubtful, 0U);
}

// The same for a step of a whole period, after which a disk is where it would be if it had hardly moved.
TEST(Displacement, AStepOfAPeriodIsADoubt) {
  Scene scene = periodic_scene(Method::pairwise, 1.0, 3.0);
  const auto engine = make_reference_engine(scene, test::state_of(scene, {{3.0, 2.0, 0.0, 4.1, 0.5, 1.0}}));
  EXPECT_GT(follow(*engine, scene).doubtful, 0U);
}

// And for a displacement between two looks of more than a quarter of the period, in any direction.
TEST(Displacement, ALookThatComesTooLateIsADoubt) {
  const Domain box = test::box_of(10.0, 10.0, test::Periodic::both);
  for (const double way : {2.0, 4.0, -2.0, -4.0}) {
    DisplacementTally tally;
    begin_displacement(tally, test::disks_of({{5.0, 5.0}}), box, 0.0);
    look_at(tally, test::disks_of({{5.0 + way, 5.0}}), box, 1.0);
    EXPECT_EQ(tally.doubtful, std::abs(way) > 2.5 ? 1U : 0U) << way;
  }
}

// A displacement of a quarter of the period is not doubtful, even if the rounding of both ends makes it five parts of
// 1/16.
TEST(Displacement, AQuarterOfThePeriodIsNoDoubt) {
  const Domain box = test::box_of(10.0, 10.0, test::Periodic::both);
  const double before = std::nextafter(0.625, 0.0);
  ASSERT_EQ(before + 2.5, 3.125) << "both are ends of parts";
  DisplacementTally tally;
  begin_displacement(tally, test::disks_of({{before, 3.125}}), box, 0.0);
  look_at(tally, test::disks_of({{before + 2.5, before}}), box, 1.0);
  EXPECT_EQ(tally.doubtful, 0U);
}

// Rounds are counted from where a disk is first seen, in both directions; one disk comes later.
TEST(Displacement, RoundsAreThoseSinceTheFirstLook) {
  const Domain box = test::box_of(10.0, 10.0, test::Periodic::both);
  DisplacementTally tally;
  for (int k = 0; k <= 40; ++k) {
    const double x = 9.0 + 2.0 * k, y = 1.3 - 1.5 * k, later = 0.5 - (k - 5);
    Disks d;
    append(d, {wrap(x, 10.0), wrap(y, 10.0), 0.0, 0.0, 0.5, 1.0, 0});
    if (k >= 5) append(d, {wrap(later, 10.0), 5.0, 0.0, 0.0, 0.5, 1.0, 2});
    follow_rounds(tally, d, box, k);
    EXPECT_EQ(rounds_of(tally.x, 0), std::floor(x / 10.0)) << k;
    EXPECT_EQ(rounds_of(tally.y, 0), std::floor(y / 10.0)) << k;
    EXPECT_EQ(rounds_of(tally.x, 2), k >= 5 ? std::floor(later / 10.0) : 0.0) << k;
    EXPECT_EQ(rounds_of(tally.y, 2), 0) << k;
  }
  EXPECT_EQ(tally.doubtful, 0U);
}

// A disk that flies along x at speed 1 in a window from 0 to 1, and at speed 12.5 in one from 1 to 1.2, as if kicked by
// a moving floor.
class KickedDisk : public test::ScriptedEngine {
 public:
  KickedDisk() { state_.disks = test::disks_of({{0.5, 2.0, 1.0, 0.0}}); }
  void step() override {
    begin_ = state_.time;
    state_.time = begin_ == 0.0 ? 1.0 : 1.2;
    disks_at(state_.time, state_.disks);
  }
  const State& state() const override { return state_; }
  double disks_at(double t, Disks& out) const override {
    t = std::max(t, begin_);
    const double far = 0.5 + std::min(t, 1.0) + 12.5 * std::max(t - 1.0, 0.0);
    out = test::disks_of({{far < 10.0 ? far : far - 10.0, 2.0, begin_ == 0.0 ? 1.0 : 12.5, 0.0}});
    return t;
  }
  std::vector<DiskContact> contacts() const override { return {}; }
  const PhaseTimes& phase_times() const override { return times_; }
  std::vector<std::string> take_warnings() override { return {}; }

 private:
  double begin_ = 0.0;
  State state_;
  PhaseTimes times_;
};

// The first window is too short for a look at its end, and the second too long to be combined with it. Since the
// position between the two is known, there is no doubt.
TEST(Displacement, TheLastLookMayLieBeforeALongWindow) {
  Scene scene = test::scene_of(Method::exact, 10.0, 10.0, 0.0, 1.2);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  KickedDisk engine;
  const Followed f = follow(engine, scene);
  EXPECT_NEAR(f.mean.value, 3.5 * 3.5, 1e-9);
  EXPECT_EQ(f.doubtful, 0U);
}

// The speeds of many disks are not looked at in every step, but only when one may have come far. That they start at
// rest must not prevent this if gravity or a thermostat sets them going. All move in the same way, or by less than a
// quarter of the period in a step.
TEST(Displacement, ManyDisksAtRestAreFollowedWhenTheyAreSetGoing) {
  for (const bool falls : {true, false}) {
    Scene scene = periodic_scene(Method::pairwise, 1.0, 40.0);
    constexpr std::size_t disks = 4200;
    scene.box.width = 6.0 * disks;
    scene.box.height = 8.0;
    if (falls) scene.physics.gravity = 0.02;
    if (!falls)
      scene.physics.thermostat = {Thermostat::Kind::andersen, 0.01, 0.01, 100.0};  // a single kick, at the start
    std::vector<Disk> list;
    for (std::size_t i = 0; i < disks; ++i) list.push_back({6.0 * static_cast<double>(i) + 3.0, 4.0, 0, 0, 1.0, 1.0});
    const auto engine = make_parallel_engine(scene, test::state_of(scene, list), {1});
    DisplacementTally tally, each_step;
    for (DisplacementTally* t : {&tally, &each_step}) begin_displacement(*t, engine->state().disks, scene.box, 0.0);
    while (engine->state().time < scene.run.t_end) {
      engine->step();
      const State& now = engine->state();
      look_at(each_step, now.disks, scene.box, now.time);
      if (follow_disks(tally, *engine, scene, now.time)) look_at(tally, now.disks, scene.box, now.time);
    }
    const State& end = engine->state();
    look_at(tally, end.disks, scene.box, end.time);
    const MeanSquare mean = mean_square_displacement(tally, end.disks, scene.box);
    EXPECT_EQ(mean.value, mean_square_displacement(each_step, end.disks, scene.box).value) << falls;
    if (falls) {
      EXPECT_NEAR(mean.value, 16.0 * 16.0, 1.0) << "g t^2 / 2";
    }
    EXPECT_EQ(tally.doubtful, 0U) << falls;
  }
}

// Many disks at rest that all rise at speed 1 after the first step.
class FleetSetGoing : public test::ScriptedEngine {
 public:
  explicit FleetSetGoing(std::size_t disks) {
    for (DiskId id = 0; id < disks; ++id) append(state_.disks, {id + 0.5, 8.0, 0.0, 0.0, 0.1, 1.0, id});
  }
  void step() override {
    state_.time += 1.0;
    if (state_.time < 2.0) return;
    state_.disks.vy.assign(state_.disks.size(), 1.0);
    for (double& y : state_.disks.y) y = wrap(y + 1.0, 16.0);
  }
};

// A disk that rises by 3 in a step and is at rest afterwards.
class StoppedDisk : public test::ScriptedEngine {
 public:
  StoppedDisk() { append(state_.disks, {3.0, 8.0, 0.0, 3.0, 0.1, 1.0, 0}); }
  void step() override {
    state_.time += 1.0;
    state_.disks.y[0] += state_.disks.vy[0];
    state_.disks.vy[0] = 0.0;
  }
};

// Whether a disk may have come so far that a look is due follows from its speed at the start of the step.
TEST(Displacement, OfADiskThatHasStoppedTheSpeedBeforeCounts) {
  Scene scene = periodic_scene(Method::pairwise, 1.0, 40.0);
  scene.box.width = scene.box.height = 16.0;
  StoppedDisk engine;
  DisplacementTally tally;
  begin_displacement(tally, engine.state().disks, scene.box, 0.0);
  engine.step();
  EXPECT_TRUE(follow_disks(tally, engine, scene, 1.0));
  look_at(tally, engine.state().disks, scene.box, 1.0);
  engine.step();
  EXPECT_FALSE(follow_disks(tally, engine, scene, 2.0));
}

// If disks are emitted, if speeds are drawn, or if moving obstacles hit disks, the speeds of many disks do not tell
// when some will move: they are looked at in every step.
TEST(Displacement, ManyDisksAreAskedWhereSpeedsComeFromElsewhere) {
  constexpr std::size_t disks = 4200;
  for (const char* why : {"source", "diffusion", "thermostat", "hot side", "moving side", "inner wall"}) {
    Scene scene = periodic_scene(Method::pairwise, 1.0, 40.0);
    scene.box.width = disks;
    scene.box.height = 16.0;
    if (why[0] == 's') scene.sources.emplace_back();
    if (why[0] == 'd') scene.physics.diffusion = 1.0;
    if (why[0] == 'h') scene.box.temperatures[0] = 1.0;
    if (why[0] == 'm') scene.box.motions[0] = {SideMotion::Kind::steady, 0.0, 1.0};
    scene.box.inner_walls_move = why[0] == 'i';
    if (why[0] == 't') scene.physics.thermostat = {Thermostat::Kind::langevin, 1.0, 1.0, 1.0};
    FleetSetGoing engine(disks);
    const Followed f = follow(engine, scene);
    EXPECT_NEAR(f.mean.value, 39.0 * 39.0, 1e-6) << why;
    EXPECT_EQ(f.doubtful, 0U) << why;
  }
}

// The times of looks and speeds are those of the disks looked at, whenever in a run this begins: the reach of disks is
// counted from these times on.
TEST(Displacement, LooksAreOfTheTimesOfTheDisks) {
  const Domain box = test::box_of(6.0, 4.0, test::Periodic::both);
  const Disks disks = test::disks_of(rows(3, 2.0));
  DisplacementTally tally, rounds;
  begin_displacement(tally, disks, box, 50.0);
  follow_rounds(rounds, disks, box, 50.0);
  for (const DisplacementTally* const begun : {&tally, &rounds}) {
    EXPECT_EQ(begun->looked_at, 50.0);
    EXPECT_EQ(begun->checked_at, 50.0);
    EXPECT_EQ(begun->fastest, fastest_speed(WholeDisks(disks, 50.0)));
  }
  look_at(tally, disks, box, 51.0);
  follow_rounds(rounds, disks, box, 51.0);
  EXPECT_EQ(tally.looked_at, 51.0);
  EXPECT_EQ(rounds.looked_at, 51.0);
}

// 4 D t if collisions are rare; the mean of n squares of two components has the relative standard error 1 / sqrt(n).
TEST(Displacement, BrownianMotionGivesFourDt) {
  for (const Method method : {Method::pairwise, Method::exact}) {
    Scene scene = periodic_scene(method, 0.01, 4.0);
    scene.physics.diffusion = 1.5;
    scene.box.width = 60.0;
    scene.box.height = 40.0;
    test::Draws draws(6);
    const auto list = test::random_disks(draws, scene.box, 600, {0.02, 0.02});
    const auto engine = make_parallel_engine(scene, test::state_of(scene, list), {1});
    const Followed f = follow(*engine, scene);
    EXPECT_NEAR(f.mean.value / (4.0 * 1.5 * 4.0), 1.0, 4.0 / std::sqrt(600.0)) << test::name_of(method);
    EXPECT_EQ(f.doubtful, 0U);
  }
}

TEST(Displacement, OverThoseThatWereThereAndStillAre) {
  Domain box{10.0, 10.0};
  DisplacementTally tally;
  Disks disks = test::disks_of({{1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}});
  begin_displacement(tally, disks, box, 0.0);
  Disks later;  // disk 1 is gone, 7 has come, 2 and 0 have moved and changed places in memory
  append(later, {3.0, 5.0, 0.0, 0.0, 0.5, 1.0, 2});
  append(later, {8.0, 8.0, 0.0, 0.0, 0.5, 1.0, 7});
  append(later, {4.0, 1.0, 0.0, 0.0, 0.5, 1.0, 0});
  look_at(tally, later, box, 1.0);
  const MeanSquare mean = mean_square_displacement(tally, later, box);
  EXPECT_EQ(mean.disks, 2U);
  EXPECT_EQ(mean.value, (4.0 + 9.0) / 2.0);
  EXPECT_TRUE(std::isnan(mean_square_displacement(tally, Disks{}, box).value));
}

}  // namespace
}  // namespace carom
