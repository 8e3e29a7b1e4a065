// carom check predicts what a run costs: the steps after the first, and the memory of ffmpeg beside its own.
#include <cmath>

#include "app/run/check_foresight.hpp"
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

// A first window of a second to t = 0.03, two more of half a second in all to 0.13: 5 s a unit of time, not 33.
TEST(StepTrial, TheFirstStepIsPaidOnce) {
  const StepTrial trial{1.0, 0.03, 1.5, 0.13};
  EXPECT_NEAR(trial.seconds_to(1.03), 1.0 + 5.0, 1e-12);
  EXPECT_NEAR(trial.seconds_to(0.13), 1.5, 1e-12);
}

TEST(StepTrial, OneStepAloneStandsForAll) {
  EXPECT_NEAR((StepTrial{1.0, 0.5, 1.0, 0.5}.seconds_to(2.0)), 4.0, 1e-12);
  EXPECT_TRUE(std::isinf(StepTrial{}.seconds_to(2.0)));
  EXPECT_EQ(StepTrial{}.seconds_to(0.0), 0.0);
}

using LongCheckCost = test::CommandTest;

// 60 MB and 70 bytes a pixel; what the pictures take in the run itself comes on top.
TEST_F(LongCheckCost, AMovieNeedsFfmpegsMemoryToo) {
  const auto bytes = [&](const std::string& set) {
    return Json::parse(carom("check small.toml --json" + set).out)["memory_bytes"].get<double>();
  };
  const std::string movie = " --set 'output.movie={ size = [640, 480] }'";
  EXPECT_GT(bytes(movie), bytes("") + 60e6 + 70.0 * 640.0 * 480.0);
  EXPECT_THAT(carom("check small.toml" + movie).out, HasSubstr(", 81.5 MB of it for ffmpeg"));
  EXPECT_THAT(carom("check small.toml").out, Not(HasSubstr("ffmpeg")));
}

}  // namespace
}  // namespace carom
