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
constexpr double window = 0.01;

// Where a disk at rest stands, which ends a window at each emission time.
Source blocked_source() {
  Source source;
  source.rate = 1.0 / window;
  source.region_low = source.region_high = {1.0, 1.0};
  source.radius.value = 0.5;
  source.mass.value = 1.0;
  return source;
}

// Pair k meets head on in window k, when this share of it has passed.
std::vector<Disk> pairs_that_meet(double share) {
  std::vector<Disk> disks{{1.0, 1.0, 0.0, 0.0, 0.5, 1.0}};
  for (int k = 0; k < pairs; ++k) {
    const Vec2 middle = test::cell_centre(k, 10, 8.0);
    const double apart = 0.5 + (k + share) * window;
    disks.push_back({middle.x - apart, middle.y, 1.0, 0.0, 0.5, 1.0});
    disks.push_back({middle.x + apart, middle.y, -1.0, 0.0, 0.5, 1.0});
  }
  return disks;
}

TEST(ShortWindows, HaveEventsUpToTheirEnds) {
  for (const double share : {0.25, 0.9995, 0.9999999}) {
    Scene scene = test::scene_of(Method::exact, 80.0, 80.0, 0.0, pairs * window);
    scene.sources = {blocked_source()};
    const State start = test::state_of(scene, pairs_that_meet(share));
    const auto reference = make_reference_engine(scene, start);
    const auto engine = make_parallel_engine(scene, start, {1});
    while (reference->state().time < scene.run.t_end) {
      reference->step();
      engine->step();
      ASSERT_EQ(engine->state().time, reference->state().time);
      ASSERT_EQ(engine->state().counters.collisions, reference->state().counters.collisions);
      ASSERT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks));
    }
    EXPECT_EQ(reference->state().counters.collisions, Count{pairs});
  }
}

}  // namespace
}  // namespace carom
