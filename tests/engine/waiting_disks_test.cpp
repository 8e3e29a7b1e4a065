// Disks of a source that find no room: where and when the exact method tries them again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "core/disks/gravity.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/window_start.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/source_by_hand.hpp"

namespace carom {
namespace {

Source gas_source(double rate, Vec2 low, Vec2 high) {
  Source source = test::source_in(low, high, rate, 0.5);
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 1.0;
  return source;
}

// At a packing fraction of 0.24 about one place in five has room for a disk: all disks come when they are due.
TEST(WaitingDisks, HaveManyPlacesToComeTo) {
  Scene scene = test::scene_of(Method::exact, 40.0, 40.0, 0.0, 25.0);
  scene.sources = {gas_source(20.0, {1.0, 1.0}, {39.0, 39.0})};
  const State end = test::run(scene, test::state_of(scene, {}));
  EXPECT_EQ(end.counters.emitted, 499U);
  EXPECT_EQ(end.counters.waiting, 0U);
}

// Disks fall from one place with g = 1.6, and one is due in each unit of time. The previous disk has fallen by a
// diameter after 1.118, so the place is free at the next quarter, 1.25 after it came: disks come at 2.25, 3.5, 4.75 and
// so on.
TEST(WaitingDisks, ComeWithinAQuarterOfTheTimeBetweenTwoAfterThereIsRoom) {
  Scene scene = test::scene_of(Method::exact, 4.0, 200.0, 0.0, 10.9);
  scene.physics.gravity = Gravity(0.0, 1.6);
  scene.sources = {test::source_in({2.0, 199.0}, {2.0, 199.0}, 1.0, 0.5)};
  const auto engine = make_reference_engine(scene, test::state_of(scene, {}));
  while (engine->state().time < scene.run.t_end) {
    const double now = engine->state().time;
    engine->step();
    const double came = now < 1.0 ? 0.0 : 1.0 + std::floor((now - 1.0) / 1.25);
    EXPECT_EQ(static_cast<double>(engine->state().counters.emitted), came) << "window from t = " << now;
  }
  EXPECT_EQ(engine->state().counters.emitted, 8U);
  EXPECT_EQ(engine->state().counters.waiting, 2U);
}

// A disk at rest blocks the source: after the first few, each disk that is due ends only one window, also if the limit
// is smaller than that number.
TEST(WaitingDisks, EndNoWindowsInBetweenWhereManyWait) {
  for (const Count limit : {Count{5}, Count{2000}}) {
    Scene scene = test::scene_of(Method::exact, 4.0, 4.0, 0.0, 100.0);
    scene.sources = {test::source_in({2.0, 2.0}, {2.0, 2.0}, 10.0, 0.5)};
    scene.sources[0].limit = limit;
    const State end = test::run(scene, test::state_of(scene, {{2.0, 2.0, 0.0, 0.0, 0.5, 1.0}}));
    EXPECT_EQ(end.counters.emitted, 0U);
    EXPECT_EQ(end.counters.waiting, std::min(limit, Count{999}));
    EXPECT_GE(end.counters.steps, 1000U);
    EXPECT_LE(end.counters.steps, 1040U);
  }
}

// The places at which a source of one disk per unit of time tries a disk at time t, if no place has room.
std::set<std::pair<double, double>> places_tried(const Scene& scene, State& state, double t) {
  std::set<std::pair<double, double>> places;
  state.time = t;
  state.step_begun = false;  // as at the end of a window
  emit_at_window_start(scene, state, [&](const Disk& d) { return places.insert({d.x, d.y}), false; });
  return places;
}

Scene of_one_source() {
  Scene scene = test::scene_of(Method::exact, 20.0, 20.0, 0.0, 100.0);
  scene.sources = {test::source_in({1.0, 1.0}, {19.0, 19.0}, 1.0, 0.5)};
  return scene;
}

TEST(WaitingDisks, AreTriedAt32PlacesAndAtOthersAtEachQuarter) {
  const Scene scene = of_one_source();
  State state = test::state_of(scene, {});
  std::set<std::pair<double, double>> all;
  for (const double t : {1.0, 1.25, 1.5, 1.75, 2.0}) {
    const auto places = places_tried(scene, state, t);
    EXPECT_EQ(places.size(), 32U) << "t = " << t;
    all.insert(places.begin(), places.end());
  }
  EXPECT_EQ(all.size(), 5U * 32U);
  EXPECT_TRUE(places_tried(scene, state, 2.125).empty()) << "2.125 is no quarter";
}

// Windows that end at other times change nothing.
TEST(WaitingDisks, AreTriedAtQuartersWhileFewerThanEightWait) {
  const Scene scene = of_one_source();
  State state = test::state_of(scene, {});
  EXPECT_TRUE(places_tried(scene, state, 0.75).empty()) << "no disk is due";
  EXPECT_EQ(places_tried(scene, state, 7.25).size(), 32U);
  EXPECT_EQ(next_cut(scene, state), 7.5);
  EXPECT_EQ(places_tried(scene, state, 8.0).size(), 32U);
  EXPECT_TRUE(places_tried(scene, state, 8.25).empty());
  EXPECT_EQ(next_cut(scene, state), 9.0);
  EXPECT_EQ(state.counters.waiting, 8U);
}

TEST(WaitingDisks, DoNotComeBeforeTheyAreDue) {
  const Scene scene = of_one_source();
  State state = test::state_of(scene, {});
  state.time = 1.25;
  emit_at_window_start(scene, state, [](const Disk&) { return true; });
  EXPECT_EQ(state.counters.emitted, 1U);
  EXPECT_EQ(state.counters.waiting, 0U);
}

// A run that is continued beyond its end, where the end was later than an emission time or a quarter by a rounding.
TEST(WaitingDisks, AreTriedAtTheEndOfARunThatGoesOn) {
  const Scene scene = of_one_source();
  State state = test::state_of(scene, {});
  for (const double t : {3.0, 3.25}) {
    EXPECT_EQ(places_tried(scene, state, std::nextafter(t, std::numeric_limits<double>::max())).size(), 32U);
  }
}

// Only half of the region is further inside the walls than a radius.
TEST(WaitingDisks, AreInsideTheBoxWhereverTheyAreTried) {
  Scene scene = test::scene_of(Method::exact, 20.0, 20.0, 0.0, 100.0);
  scene.sources = {test::source_in({0.0, 0.0}, {1.0, 20.0}, 1.0, 0.5)};
  State state = test::state_of(scene, {});
  for (int k = 1; k <= 7; ++k) {
    for (const auto& [x, y] : places_tried(scene, state, k)) {
      EXPECT_TRUE(x >= 0.5 && y >= 0.5 && y <= 19.5) << x << ", " << y;
    }
  }
}

TEST(WaitingDisks, HaveTheReferencesBits) {
  Scene scene = test::scene_of(Method::exact, 30.0, 30.0, 0.0, 20.0);
  scene.box.sides[static_cast<std::size_t>(Side::right)] = SideKind::sink;
  scene.sources = {gas_source(30.0, {1.0, 1.0}, {15.0, 29.0}), gas_source(2.0, {5.0, 15.0}, {5.1, 15.0})};
  const State reference = test::run(scene, test::state_of(scene, {}));
  EXPECT_GT(reference.counters.waiting, 0U);
  for (const int threads : {1, 2, 3}) {
    const auto engine = make_parallel_engine(scene, test::state_of(scene, {}), {threads, 64});
    while (engine->state().time < scene.run.t_end) engine->step();
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(reference.disks)) << threads << " threads";
    EXPECT_EQ(engine->state().counters.emitted, reference.counters.emitted);
  }
}

}  // namespace
}  // namespace carom
