// Two hundred random scenes with all features: every engine has the bits of the reference, at every number of threads,
// with frames, interrupted and resumed, and the states are plausible (sanity.hpp). carom_fuzz_scenes tries more scenes.
#include <gtest/gtest.h>

#include <string>

#include "tests/fuzz_scenes/random_scene.hpp"
#include "tests/fuzz_scenes/trial.hpp"

namespace carom::fuzz {
namespace {

constexpr std::uint32_t shards = 8, scenes_a_shard = 25;
constexpr std::uint64_t seed = 13;
constexpr std::uint32_t most_attempts = 50;

class RandomScenes : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomScenes, HaveTheSameBitsInEveryEngine) {
  for (std::uint32_t k = 0; k < scenes_a_shard; ++k) {
    const std::uint32_t number = GetParam() * scenes_a_shard + k;
    bool refused = true;
    for (std::uint32_t attempt = 0; refused && attempt < most_attempts; ++attempt) {
      const std::string text = random_scene(seed, number, attempt);
      const Trial trial = try_scene(text, "scene");
      for (const std::string& fault : trial.faults) ADD_FAILURE() << fault << "\n" << text;
      refused = !trial.refusal.empty();
    }
    EXPECT_FALSE(refused) << "scene " << number << " cannot be made";
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomScenes, ::testing::Range(0U, shards));

}  // namespace
}  // namespace carom::fuzz
