// Windows so short that few disks have an event in them: the calendar leaves out the other disks, but none whose event
// comes before the window's end.
#include <gtest/gtest.h>

#include <vector>

#include "core/disks/state_hash.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr int pairs = 100;

// A source whose place is taken by a disk at rest; it ends a window at each emission time.
Source blocked_source(double window) {
  Source source;
  source.rate = 1.0 / window;
  source.region_low = source.region_high = {1.0, 1.0};
  source.radius.value = 0.5;
  source.mass.value = 1.0;
  return source;
}

// Pair k meets head-on in window k, after this share of it.
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

// Pairs in which a disk follows another and gains on it with at most this speed, so that they touch at the end of the
// second, third or fourth window. Rounding at the windows' starts shifts these contacts by times that go as 1 / speed.
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

// The source makes windows much shorter than planned, so that a share of their length is less than the shift of slow
// contacts by rounding. Hence the margin of kept times is a share of the planned length.
TEST(ShortWindows, HaveSlowContactsAtTheirEnds) {
  constexpr double window = 5e-5;
  for (const double speed : {3e-8, 1e-7}) {
    EXPECT_GT(collisions_beside_the_reference(window, pairs_that_creep_up(window, speed)), Count{pairs / 2}) << speed;
  }
}

}  // namespace
}  // namespace carom
