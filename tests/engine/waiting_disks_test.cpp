// Disks of a source that find no room: where and when the exact method tries them again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "core/disks/gravity.hpp"
#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

Source source_of(double rate, Vec2 low, Vec2 high) {
  Source source;
  source.rate = rate;
  source.region_low = low;
  source.region_high = high;
  source.radius.value = 0.5;
  source.mass.value = 1.0;
  return source;
}

Source gas_source(double rate, Vec2 low, Vec2 high) {
  Source source = source_of(rate, low, high);
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 1.0;
  return source;
}

// At a packing fraction of 0.24, a disk finds room at one place in five or so: all come when they are due.
TEST(WaitingDisks, HaveManyPlacesToComeTo) {
  Scene scene = test::scene_of(Method::exact, 40.0, 40.0, 0.0, 25.0);
  scene.sources = {gas_source(20.0, {1.0, 1.0}, {39.0, 39.0})};
  const State end = test::run(scene, test::state_of(scene, {}));
  EXPECT_EQ(end.counters.emitted, 499U);
  EXPECT_EQ(end.counters.waiting, 0U);
}

// Disks fall from one place, g = 1.6, one a unit of time. The one before has fallen by a diameter after 1.118, so that
// the place is free 1.25 after it: at 2.25, 3.5, 4.75 and so on, k quarters.
TEST(WaitingDisks, ComeWithinAQuarterOfTheTimeBetweenTwoAfterThereIsRoom) {
  Scene scene = test::scene_of(Method::exact, 4.0, 200.0, 0.0, 10.9);
  scene.physics.gravity = Gravity(0.0, 1.6);
  scene.sources = {source_of(1.0, {2.0, 199.0}, {2.0, 199.0})};
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

// A disk at rest where the source is: after the first few, each that is due ends one window alone.
TEST(WaitingDisks, EndNoWindowsInBetweenWhereManyWait) {
  Scene scene = test::scene_of(Method::exact, 4.0, 4.0, 0.0, 100.0);
  scene.sources = {source_of(10.0, {2.0, 2.0}, {2.0, 2.0})};
  const State end = test::run(scene, test::state_of(scene, {{2.0, 2.0, 0.0, 0.0, 0.5, 1.0}}));
  EXPECT_EQ(end.counters.emitted, 0U);
  EXPECT_EQ(end.counters.waiting, 999U);
  EXPECT_GE(end.counters.steps, 1000U);
  EXPECT_LE(end.counters.steps, 1040U);
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
