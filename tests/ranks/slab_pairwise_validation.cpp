// `pairwise` on several ranks, thoroughly: all combinations of features on every number of ranks and threads, and long
// runs. A smaller selection, and more: slab_pairwise_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <string>

#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

using test::expect_bits;
using test::light_between_heavy;
using test::local_trace;
using test::slab_scene;

class SlabFeatures : public ::testing::TestWithParam<const char*> {};

// There are 15 steps, since after 20 the moving sides would leave the box.
TEST_P(SlabFeatures, HaveTheBitsOfOneMachineAfterEveryStep) {
  Count collisions = 0;
  const std::vector<Scene> scenes = test::slab_scenes(GetParam(), 15);
  ASSERT_GE(scenes.size(), 12U);
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.title);
    collisions += expect_bits(scene, {1, 2, 3, 4}).counters.collisions;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(collisions, 30U * scenes.size());
}

INSTANTIATE_TEST_SUITE_P(Sides, SlabFeatures,
                         ::testing::Values("wall", "periodic", "periodic_x", "soft", "sink", "moving", "hot"),
                         [](const auto& p) { return std::string(p.param); });

// Long enough for many sorts into cells, and for disks to move through all slabs.
TEST(SlabRun, HasTheBitsWhileDisksMoveFromSlabToSlab) {
  const Scene scene = slab_scene("periodic", "width = 30.0\nheight = 40.0\n",
                                 "count = 400\npositions = \"random\"\nradius = 0.5\nmass = 1.0\n"
                                 "velocities = { maxwell = 4.0 }\n",
                                 0.05, 400);
  EXPECT_GT(expect_bits(scene, {2, 3, 4}).counters.collisions, 10'000U);
  const State start = initial_state(scene);
  EXPECT_GT(local_trace(scene, start, {1, 1}, 4).most_moved, 0U);
}

// Light disks between approaching heavy ones are sent through whole slabs within a step.
TEST(SlabRun, HasTheBitsWhereDisksGoFarInAStep) {
  const Scene scene = slab_scene("periodic", "width = 24.0\nheight = 16.0\n", light_between_heavy("1e-6"), 0.2, 40);
  EXPECT_GT(expect_bits(scene, {2, 3, 8}).counters.collisions, 200U);
}

// Elastic disks fall: slabs become empty and fill again.
TEST(SlabRun, HasTheBitsWhereSlabsRunEmpty) {
  const Scene scene = slab_scene("wall", "width = 30.0\nheight = 30.0\n[physics]\ngravity = 8.0\n",
                                 "count = 60\npositions = \"random\"\nradius = { uniform = [0.2, 0.6] }\n"
                                 "mass = { uniform = [1, 20] }\nvelocities = { uniform = 1.0 }\n",
                                 0.01, 700);
  std::size_t least = 60;
  const State start = initial_state(scene);
  std::mutex mutex;
  run_on_local_ranks(4, [&](Ranks& ranks) {
    const auto engine = make_slab_pairwise(scene, start, {1}, ranks);
    while (engine->state().time < scene.run.t_end) {
      engine->step();
      const std::lock_guard lock(mutex);
      least = std::min(least, engine->state().disks.size());
    }
  });
  EXPECT_EQ(least, 0U);
  EXPECT_GT(expect_bits(scene, {4}).counters.wall_collisions, 100U);
}

}  // namespace
}  // namespace carom
