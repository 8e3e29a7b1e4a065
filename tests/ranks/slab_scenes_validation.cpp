// Random scenes with all features on several ranks: the bits of a single machine after every step. So no new feature
// can be forgotten in slabs.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz_scenes/random_scene.hpp"
#include "tests/fuzz_scenes/trial.hpp"
#include "tests/fuzz_scenes/wide_scene.hpp"

namespace carom {
namespace {

constexpr std::uint32_t shards = 4, scenes_a_shard = 500, wide_a_shard = 100;
constexpr std::uint64_t seed = 19;
struct RankCounts {
  std::size_t on_slabs = 0, alone = 0;  // as in RankTrial
};

// text: a scene that can be made.
void compare_on_ranks(const std::string& text, RankCounts& ranks) {
  const fuzz::RankTrial trial = fuzz::try_on_ranks(text, "scene");
  ranks.on_slabs += trial.on_slabs;
  ranks.alone += trial.alone;
  for (const std::string& fault : trial.faults) ADD_FAILURE() << fault << "\n" << text;
}

class SlabScenes : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(SlabScenes, HaveTheBitsOfOneMachine) {
  RankCounts ranks;
  for (std::uint32_t k = 0; k < scenes_a_shard; ++k) {
    compare_on_ranks(fuzz::random_scene(seed, GetParam() * scenes_a_shard + k, 0), ranks);
  }
  EXPECT_GE(ranks.on_slabs, 10U);
  EXPECT_GE(ranks.alone, 10U);
}

TEST_P(SlabScenes, OfOtherKindsHaveThemToo) {
  RankCounts ranks;
  for (std::uint32_t k = 0; k < wide_a_shard; ++k) {
    compare_on_ranks(fuzz::wide_scene(seed, GetParam() * wide_a_shard + k, 0), ranks);
  }
  EXPECT_GE(ranks.on_slabs, 10U);
}

INSTANTIATE_TEST_SUITE_P(Shards, SlabScenes, ::testing::Range(0U, shards));

}  // namespace
}  // namespace carom
