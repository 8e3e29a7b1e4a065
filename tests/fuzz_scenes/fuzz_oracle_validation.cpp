// Two thousand small random scenes: the method `exact` compared with a simulation that tests all pairs in long double.
#include <gtest/gtest.h>

#include <string>

#include "tests/fuzz_scenes/random_scene.hpp"
#include "tests/fuzz_scenes/trial.hpp"

namespace carom::fuzz {
namespace {

constexpr std::uint32_t shards = 4, scenes_a_shard = 500;
constexpr std::uint64_t seed = 3;
class OracleScenes : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(OracleScenes, HaveTheOraclesPaths) {
  std::uint32_t refused = 0;
  for (std::uint32_t k = 0; k < scenes_a_shard; ++k) {
    const std::uint32_t number = GetParam() * scenes_a_shard + k;
    const std::string text = random_oracle_scene(seed, number, 0);
    const Trial trial = try_against_oracle(text, "scene");
    for (const std::string& fault : trial.faults) ADD_FAILURE() << fault << "\n" << text;
    if (!trial.refusal.empty()) ++refused;
  }
  EXPECT_LT(refused, scenes_a_shard / 10);
}

INSTANTIATE_TEST_SUITE_P(Shards, OracleScenes, ::testing::Range(0U, shards));

}  // namespace
}  // namespace carom::fuzz
