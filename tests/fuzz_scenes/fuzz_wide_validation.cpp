// Random scenes of the kinds in which collisions were once lost (wide_scene.hpp): engines compared with the reference,
// and the method `exact` with a simulation that tests all pairs in long double. There are only a few here:
// carom_fuzz_scenes --wide tries more.
#include <gtest/gtest.h>

#include <string>

#include "tests/fuzz_scenes/trial.hpp"
#include "tests/fuzz_scenes/wide_scene.hpp"

namespace carom::fuzz {
namespace {

constexpr std::uint32_t shards = 8;
constexpr std::uint64_t seed = 17;
constexpr std::uint32_t most_attempts = 50;

class WideScenes : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  template <class Make, class Try>
  void try_scenes(std::uint32_t count, Make&& make, Try&& attempt_at) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t number = GetParam() * count + k;
      bool refused = true;
      for (std::uint32_t attempt = 0; refused && attempt < most_attempts; ++attempt) {
        const std::string text = make(seed, number, attempt);
        const Trial trial = attempt_at(text);
        for (const std::string& fault : trial.faults) ADD_FAILURE() << fault << "\n" << text;
        refused = !trial.refusal.empty();
      }
      EXPECT_FALSE(refused) << "scene " << number << " cannot be made";
    }
  }
};

TEST_P(WideScenes, HaveTheSameBitsInEveryEngine) {
  try_scenes(3, wide_scene, [](const std::string& text) { return try_scene(text, "scene"); });
}

TEST_P(WideScenes, HaveTheOraclesPaths) {
  try_scenes(6, wide_oracle_scene, [](const std::string& text) { return try_against_oracle(text, "scene"); });
}

INSTANTIATE_TEST_SUITE_P(Shards, WideScenes, ::testing::Range(0U, shards));

}  // namespace
}  // namespace carom::fuzz
