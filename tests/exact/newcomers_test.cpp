// Disks emitted by sources into an exact run are added to the existing lists: the bits are those of the reference, from
// an empty box on, and for any radii.
#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/source_by_hand.hpp"

namespace carom {
namespace {

Source gas_from(double rate, Vec2 low, Vec2 high, SizeLaw radius) {
  Source source = test::source_in(low, high, rate, 0.0);
  source.radius = std::move(radius);
  source.velocities.kind = VelocityLaw::Kind::maxwell;
  source.velocities.temperature = 1.0;
  return source;
}

SizeLaw constant(double radius) {
  SizeLaw law;
  law.value = radius;
  return law;
}

SizeLaw one_of(std::vector<double> radii) {
  SizeLaw law;
  law.kind = SizeLaw::Kind::choice;
  law.weights.assign(radii.size(), 1.0);
  law.values = std::move(radii);
  return law;
}

Scene scene_with(const std::vector<Source>& sources) {
  Scene scene = test::scene_of(Method::exact, 60.0, 40.0, 0.1, 12.0);
  scene.sources = sources;
  return scene;
}

// In both engines windows end at the emissions; after each of them both must have the same disks.
void expect_bits_of_reference(const Scene& scene, const State& start, std::size_t disks_at_least) {
  const auto reference = make_reference_engine(scene, start);
  const auto one = make_parallel_engine(scene, start, {1});
  const auto three = make_parallel_engine(scene, start, {3, 256});
  while (reference->state().time < scene.run.t_end) {
    for (Engine* engine : {reference.get(), one.get(), three.get()}) engine->step();
    for (const Engine* engine : {one.get(), three.get()}) {
      ASSERT_EQ(engine->state().time, reference->state().time);
      ASSERT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks))
          << "at t = " << reference->state().time << ", " << reference->state().disks.size() << " disks";
    }
  }
  EXPECT_GE(reference->state().disks.size(), disks_at_least);
  EXPECT_GT(reference->state().counters.collisions, 200U);
  EXPECT_EQ(one->state().counters.collisions, reference->state().counters.collisions);
}

TEST(Newcomers, HaveTheReferencesBitsFromAnEmptyBoxOn) {
  const Scene scene = scene_with({gas_from(20.0, {1.0, 1.0}, {59.0, 39.0}, constant(0.5)),
                                  gas_from(20.0, {1.0, 1.0}, {29.0, 39.0}, constant(0.5))});
  expect_bits_of_reference(scene, test::state_of(scene, {}), 400);
}

// At first the larger ones are larger than all disks so far; then each comes where smaller and larger disks are known.
TEST(Newcomers, HaveTheReferencesBitsWhateverTheirRadii) {
  const Scene scene = scene_with({gas_from(20.0, {2.0, 2.0}, {58.0, 38.0}, one_of({0.5, 0.2})),
                                  gas_from(7.0, {2.0, 2.0}, {58.0, 38.0}, one_of({0.05, 1.1}))});
  expect_bits_of_reference(scene, test::state_of(scene, {}), 250);
}

// The newcomers are larger or smaller than all disks of a gas already listed, or differ from the common radius of its
// disks.
TEST(Newcomers, HaveTheReferencesBitsWhereTheGasHasOtherRadii) {
  for (const bool mixed : {false, true}) {
    for (const double radius : {0.1, 2.5}) {
      const Scene scene = scene_with({gas_from(2.0, {3.0, 3.0}, {57.0, 37.0}, constant(radius))});
      test::Draws draws(3);
      test::Ranges gas;
      gas.radius_low = mixed ? 0.2 : 0.3;
      gas.radius_high = 0.3;
      gas.speed = 2.0;
      const State start = test::state_of(scene, test::random_disks(draws, scene.box, 300, gas));
      expect_bits_of_reference(scene, start, 315);
    }
  }
}

// One source's corner is full, the other source has room: a disk of the second gets the id that the first has tried. If
// a window is given up and started again, by this engine or another, the first source must try no other id at that
// time.
TEST(Newcomers, ComeOnceIntoAWindowThatIsBegunTwice) {
  const Scene scene = scene_with(
      {gas_from(20.0, {1.0, 1.0}, {5.0, 5.0}, constant(0.5)), gas_from(20.0, {8.0, 8.0}, {59.0, 39.0}, constant(0.5))});
  const auto undisturbed = make_reference_engine(scene, test::state_of(scene, {}));
  State now = test::state_of(scene, {});
  int given_up = 0;
  while (undisturbed->state().time < scene.run.t_end) {
    undisturbed->step();
    const State& right = undisturbed->state();
    // A new engine calls its watch at its first event.
    const auto engine = make_parallel_engine(scene, now, {1});
    engine->set_watch([] { return false; });
    engine->step();
    engine->set_watch({});
    if (engine->state().time < right.time) {
      ++given_up;
      const auto other = make_reference_engine(scene, engine->state());
      other->step();
      ASSERT_EQ(state_hash(other->state().disks), state_hash(right.disks)) << "at t = " << right.time;
      engine->step();
    }
    now = engine->state();
    ASSERT_EQ(now.time, right.time);
    ASSERT_EQ(state_hash(now.disks), state_hash(right.disks)) << "at t = " << right.time;
    ASSERT_EQ(now.counters.waiting, right.counters.waiting);
  }
  EXPECT_GT(given_up, 100);
  EXPECT_GT(undisturbed->state().counters.waiting, 0U);
}

TEST(Newcomers, HaveTheReferencesBitsBesideASinkAndUnderGravity) {
  Scene scene = scene_with({gas_from(30.0, {1.0, 20.0}, {59.0, 39.0}, constant(0.5))});
  scene.physics.gravity = Gravity(0.0, 0.5);
  scene.physics.restitution = 0.9;
  scene.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  expect_bits_of_reference(scene, test::state_of(scene, {}), 200);
}

}  // namespace
}  // namespace carom
