// Windows so short that few disks have an event in them: the calendar leaves out the others, but none whose event comes
// before the window's end.
#include <gtest/gtest.h>

#include <vector>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr int pairs = 100;

// Where a disk at rest stands, which ends a window at each emission time.
Source blocked_source(double window) {
  Source source;
  source.rate = 1.0 / window;
  source.region_low = source.region_high = {1.0, 1.0};
  source.radius.value = 0.5;
  source.mass.value = 1.0;
  return source;
}

// Pair k meets head on in window k, when this share of it has passed.
std::vector<Disk> pairs_that_meet(double window, double share) {
  std::vector<Disk> disks{{1.0, 1.0, 0.0, 0.0, 0.5, 1.0}};
  for (int k = 0; k < pairs; ++k) {
    const Vec2 middle = test::cell_centre(k, 10, 8.0);
    const double apart = 0.5 + (k + share) * window;
    disks.push_back({middle.x - apart, middle.y, 1.0, 0.0, 0.5, 1.0});
    disks.push_back({middle.x + apart, middle.y, -1.0, 0.0, 0.5, 1.0});
  }
  return disks;
}

// Pairs fly along, one disk behind the other, which it comes up to by no more than this speed, at the end of the
// second, third or fourth window: by how much each rounding at their starts shifts when, that goes as 1 / speed.
std::vector<Disk> pairs_that_creep_up(double window, double speed) {
  std::vector<Disk> disks{{1.0, 1.0, 0.0, 0.0, 0.5, 1.0}};
  for (int k = 0; k < pairs; ++k) {
    const Vec2 middle = test::cell_centre(k, 10, 8.0);
    const double apart = 0.5 + 0.5 * speed * (k % 3 + 2) * window;
    disks.push_back({middle.x - apart, middle.y, 1.0 + speed, 0.0, 0.5, 1.0});
    disks.push_back({middle.x + apart, middle.y, 1.0, 0.0, 0.5, 1.0});
  }
  return disks;
}

Count collisions_beside_the_reference(double window, const std::vector<Disk>& disks) {
  Scene scene = test::scene_of(Method::exact, 80.0, 80.0, 0.0, pairs * window);
  scene.sources = {blocked_source(window)};
  const State start = test::state_of(scene, disks);
  const auto reference = make_reference_engine(scene, start);
  const auto engine = make_parallel_engine(scene, start, {1});
  while (reference->state().time < scene.run.t_end) {
    reference->step();
    engine->step();
    EXPECT_EQ(engine->state().time, reference->state().time);
    EXPECT_EQ(engine->state().counters.collisions, reference->state().counters.collisions);
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks));
    if (testing::Test::HasFailure()) break;
  }
  return reference->state().counters.collisions;
}

TEST(ShortWindows, HaveEventsUpToTheirEnds) {
  constexpr double window = 0.01;
  for (const double share : {0.25, 0.9995, 0.9999999}) {
    EXPECT_EQ(collisions_beside_the_reference(window, pairs_that_meet(window, share)), Count{pairs});
  }
}

// The source makes windows so much shorter than they are meant to be that a share of their own length is less than what
// rounding shifts slow contacts by: kept times come earlier by a share of what windows are meant to last.
TEST(ShortWindows, HaveSlowContactsAtTheirEnds) {
  constexpr double window = 5e-5;
  for (const double speed : {3e-8, 1e-7}) {
    EXPECT_GT(collisions_beside_the_reference(window, pairs_that_creep_up(window, speed)), Count{pairs / 2}) << speed;
  }
}

}  // namespace
}  // namespace carom
