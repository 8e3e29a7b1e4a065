// A million disks for 20 steps: the engine on two and three threads is compared with the reference after every step.
#include <gtest/gtest.h>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom {
namespace {

TEST(ParallelMillion, EqualsTheReferenceForTwentySteps) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/gas_million.toml", {{"run.method", "pairwise"}});
  const State start = initial_state(scene);
  ASSERT_EQ(start.disks.size(), 1000000U);
  const auto reference = make_reference_engine(scene, start);
  const auto two = make_parallel_engine(scene, start, {2});
  const auto three = make_parallel_engine(scene, start, {3});
  for (int k = 0; k < 20; ++k) {
    reference->step();
    two->step();
    three->step();
    const std::uint64_t expected = state_hash(reference->state().disks);
    ASSERT_EQ(expected, state_hash(two->state().disks)) << "step " << k;
    ASSERT_EQ(expected, state_hash(three->state().disks)) << "step " << k;
  }
  EXPECT_EQ(reference->state().counters.collisions, two->state().counters.collisions);
  EXPECT_GT(reference->state().counters.collisions, 300000U);
}

}  // namespace
}  // namespace carom
