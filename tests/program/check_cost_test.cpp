// carom check predicts the cost of a run: time for the steps after the first, and the memory of ffmpeg in addition to
// its own.
#include <sys/resource.h>

#include <cmath>

#include "app/run/check_foresight.hpp"
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

// A first window to t = 0.03 takes a second, two more to 0.13 take half a second together: 5 s for each unit of time,
// not 33.
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

// Haff's law: the number of collisions of a cooling gas grows as ln(1 + t / tau), so ten times the time does not cost
// ten times as much. In equilibrium the rate only fluctuates.
TEST(StepTrial, AGasThatCoolsCollidesEverLess) {
  const auto haff = [](double t) { return static_cast<Count>(1e5 * std::log1p(t)); };
  const double slowing = slowing_of_collisions(0.5, haff(0.5), 1.0, haff(1.0));
  EXPECT_NEAR(slowing, 1.0, 0.01);
  const StepTrial trial{0.1, 0.1, 0.3, 1.0, slowing};
  const double real = 0.3 + 0.2 * (std::log1p(1e4) - std::log1p(1.0)) / (std::log1p(1.0) - std::log1p(0.1));
  EXPECT_NEAR(trial.seconds_to(1e4), real, 0.02 * real) << "at the pace of the trial it would be 2200";
  EXPECT_EQ(slowing_of_collisions(50.0, 50'000, 100.0, 99'500), 0.0);
  EXPECT_EQ(slowing_of_collisions(50.0, 50'000, 100.0, 150'000), 0.0) << "collisions become more frequent";
  EXPECT_EQ(slowing_of_collisions(50.0, 100, 100.0, 110), 0.0) << "too few collisions";
  EXPECT_GT(slowing_of_collisions(50.0, 50'000, 100.0, 50'000), 1e3) << "there are no more collisions";
}

using CheckCost = test::CommandTest;
using LongCheckCost = CheckCost;

// 60 MB and 70 bytes for each pixel, in addition to the memory of the pictures in the run itself.
TEST_F(LongCheckCost, AMovieNeedsFfmpegsMemoryToo) {
  const auto bytes = [&](const std::string& set) {
    return Json::parse(carom("check small.toml --json" + set).out)["memory_bytes"].get<double>();
  };
  const std::string movie = " --set 'output.movie={ size = [640, 480] }'";
  EXPECT_GT(bytes(movie), bytes("") + 60e6 + 70.0 * 640.0 * 480.0);
  EXPECT_THAT(carom("check small.toml" + movie).out, HasSubstr(", 81.5 MB of it for ffmpeg"));
  EXPECT_THAT(carom("check small.toml").out, Not(HasSubstr("ffmpeg")));
}

// A trajectory holds a line of each disk beside the steps, and exact needs more on two threads. The peak of the
// programs that this one has started is that of the last run, as no other is as large.
TEST_F(LongCheckCost, ARunNeedsAsMuchMemoryAsForeseen) {
#if defined CAROM_ADDRESS_SANITIZER || defined CAROM_THREAD_SANITIZER
  GTEST_SKIP() << "sanitizers keep memory of their own, and freed memory for a while";
#endif
  const std::string gas = CAROM_SOURCE_DIR
      "/scenes/gas_million.toml --t-end 0.02 --set disks.0.count=300000 --set output.every=0.01 --set "
      "'output.trajectory=\"xyz\"' ";
  for (const std::string threads : {"--threads 1 ", "--threads 2 "}) {
    ASSERT_EQ(carom("run " + gas + threads + "--quiet --force -o out").status, 0);
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const double peak = 1024.0 * static_cast<double>(usage.ru_maxrss);
    const double foreseen = Json::parse(carom("check " + gas + threads + "--json").out)["memory_bytes"].get<double>();
    EXPECT_NEAR(foreseen / peak, 1.0, 0.07) << threads;
  }
}

// A source emits 2000 disks into an empty box, and the trial sees some of them: the checkpoint has 36 bytes for each
// disk, once. The previous checkpoint is that of the start.
TEST_F(CheckCost, ACheckpointHasTheDisksOfSourcesOnce) {
  write(
      "source.toml",
      "[box]\nwidth = 100.0\nheight = 100.0\n[[sources]]\nregion = [5.0, 5.0, 95.0, 95.0]\nrate = 400.0\nradius = 0.2\n"
      "mass = 1.0\nvelocities = { maxwell = 1.0 }\n[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 5.0\n[output]\n"
      "checkpoint = 1000\n");
  const Json files = Json::parse(carom("check source.toml --json").out)["files_bytes"];
  EXPECT_NEAR(files["checkpoint.carom"].get<double>(), 36.0 * 1999.0, 4000.0);
  EXPECT_LT(files["checkpoint.previous.carom"].get<double>(), 4000.0);
}

// Once its folder for temporary files, with an unfinished movie, was never removed.
TEST_F(LongCheckCost, ACheckThatIsStoppedLeavesNothingBehind) {
  const test::Outcome o = shell(
      "mkdir tmp && export TMPDIR=$PWD/tmp && $C check small.toml --set output.movie=true --set output.every=0.01 & "
      "P=$!; until ls tmp/carom-check-* >/dev/null 2>&1 || ! kill -0 $P; do sleep 0.01; done; kill -TERM $P; wait $P");
  EXPECT_EQ(o.status, 128 + 15);
  EXPECT_THAT(files_in("tmp"), ::testing::IsEmpty());
}

TEST_F(LongCheckCost, AnAnalysisHasATableForEachQuantity) {
  const std::string all =
      " --t-end 10 --set output.every=10 --set 'analysis.what=[\"speeds\", \"density\", \"displacement\", "
      "\"pressure\", "
      "\"pair_correlation\", \"bond_order\", \"velocity_autocorrelation\"]'";
  const Json files = Json::parse(carom("check small.toml --json" + all).out)["files_bytes"];
  ASSERT_EQ(carom("run small.toml --quiet -o out" + all).status, 0);
  const auto real = static_cast<double>(std::filesystem::file_size(at("out") / "analysis.h5"));
  EXPECT_GT(files["analysis.h5"].get<double>(), 0.7 * real);
  EXPECT_LT(files["analysis.h5"].get<double>(), 1.7 * real);
}

// A page of few disks is the viewer, and the plots of series.csv; without these it was foreseen at 0.6 of its size.
TEST_F(LongCheckCost, APageOfFewDisksIsAsLargeAsForeseen) {
  for (const std::string series : {"true", "false"}) {
    const std::string command =
        CAROM_SOURCE_DIR
        "/scenes/two_disks.toml --set output.movie=false --set 'output.trajectory=\"xyz\"' --set output.view=true "
        "--set output.series=" +
        series;
    const Json files = Json::parse(carom("check --json " + command).out)["files_bytes"];
    ASSERT_EQ(carom("run --quiet --force -o out " + command).status, 0);
    const auto real = static_cast<double>(std::filesystem::file_size(at("out") / "view.html"));
    EXPECT_NEAR(files["view.html"].get<double>() / real, 1.0, 0.2) << "output.series = " << series;
  }
}

// Two panels with curves, or with bands for more than ten disks; a curve of more than 4000 frames has fewer points; the
// potential energy is one more curve.
TEST_F(LongCheckCost, PlotsAreAsLargeAsTheirCurves) {
  for (const std::string settings :
       {"--set output.every=0.1", "--set output.every=0.002", "--set output.every=0.0002 --set disks.0.radius=0.1",
        "--set output.every=0.005 --set disks.0.count=30 --set physics.gravity=1.0"}) {
    const std::string command = "small.toml --method exact --set 'output.plots=[\"velocity\", \"energy\"]' " + settings;
    const Json files = Json::parse(carom("check --json " + command).out)["files_bytes"];
    ASSERT_EQ(carom("run --quiet --force -o out " + command).status, 0) << settings;
    if (!files.contains("velocity.svg")) GTEST_SKIP() << "gnuplot is not installed";
    for (const std::string name : {"velocity.svg", "energy.svg"}) {
      const auto real = static_cast<double>(std::filesystem::file_size(at("out") / name));
      EXPECT_NEAR(files[name].get<double>() / real, 1.0, 0.25) << name << " " << settings;
    }
  }
}

TEST_F(CheckCost, BrownianDisksHaveNoPlotOfEnergies) {
  const std::string plots = "small.toml --set physics.diffusion=0.1 --set 'output.plots=[\"velocity\", \"energy\"]'";
  const Json files = Json::parse(carom("check --json " + plots).out)["files_bytes"];
  ASSERT_EQ(carom("run --quiet -o out " + plots).status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out") / "energy.svg"));
  EXPECT_FALSE(files.contains("energy.svg"));
  EXPECT_EQ(files.contains("velocity.svg"), std::filesystem::exists(at("out") / "velocity.svg"));
}

// In the TC model a disk at rest makes ten collisions in a contact time, which the trial does not see while disks fall.
TEST_F(CheckCost, APileUnderTheTcModelIsDear) {
  const std::string fall =
      "check small.toml --method exact --t-end 1 --set physics.gravity=1.0 --set physics.restitution=0.8 --set ";
  EXPECT_THAT(carom(fall + "'physics.collapse={ model = \"tc\", contact_time = 1e-3 }'").out,
              HasSubstr("lie in a pile, each makes about 5e+03 collisions in a unit of time, which then takes "));
}

}  // namespace
}  // namespace carom
