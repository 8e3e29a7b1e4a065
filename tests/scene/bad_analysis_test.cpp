// The table [analysis]: what it accepts, its defaults, and the error line for everything else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "core/scene/scene_text.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::scene_from;
using ::testing::HasSubstr;

std::string with(const std::string& lines) {
  return std::string(test::sound_scene) + "[analysis]\n" + lines + "\n";
}

TEST(AnalysisScene, FillsInWhatIsNotSaidAndWritesItDown) {
  const Scene scene = scene_from(with(R"(what = ["density", "speeds", "pair_correlation", "displacement"])"));
  const AnalysisPlan& plan = scene.analysis;
  EXPECT_EQ(plan.every, 0.1) << "the default is a hundredth of the run";
  EXPECT_EQ(plan.start, 0.0);
  EXPECT_EQ(plan.pairs.r_max, 2.0) << "half of the room of centres between walls 10 apart";
  EXPECT_EQ(plan.pairs.wall_margin, 3.0);
  EXPECT_EQ(plan.pairs.bins, 50U);
  EXPECT_FALSE(plan.density_along_x);
  EXPECT_TRUE(plan.wants(Quantity::displacement));
  EXPECT_FALSE(plan.wants(Quantity::pressure));
  const std::string text = resolved_toml(scene);
  EXPECT_THAT(text, HasSubstr("pair_correlation = { r_max = 2.0, bins = 50 }\nspeeds = { max = 6.0, bins = 60 }\n"
                              "density = { axis = \"y\", bins = 50 }\n"));
  EXPECT_EQ(resolved_toml(scene_from(text)), text);
}

std::tuple<double, Count, double> numbers_of(const DistancePlan& plan) {
  return {plan.r_max, plan.bins, plan.wall_margin};
}

// Distances of pairs are chosen as if only the disks measured were there.
TEST(AnalysisScene, DistancesAreOfTheDisksThatAreMeasured) {
  const std::string large = "count = 1\npositions = [[14.0, 5.0]]\nradius = 2.0\n";
  const std::string moving = large + "mass = 1.0\n";
  const std::string wanted = "what = [\"pair_correlation\", \"bond_correlation\"]\n";
  const AnalysisPlan alone = scene_from(with(wanted)).analysis;
  const AnalysisPlan obstacle = scene_from(with(wanted + "[[disks]]\nfixed = true\n" + large)).analysis;
  EXPECT_EQ(numbers_of(obstacle.pairs), numbers_of(alone.pairs)) << "a fixed disk does not count in g(r)";
  EXPECT_EQ(numbers_of(obstacle.bonds), numbers_of(alone.bonds));
  const AnalysisPlan both = scene_from(with(wanted + "[[disks]]\nname = \"large\"\n" + moving)).analysis;
  EXPECT_EQ(both.pairs.wall_margin, both.pairs.r_max + 2.0);
  const std::string selected = test::replaced(with(wanted + "select = \"small\"\n[[disks]]\n" + moving), "[[disks]]",
                                              "[[disks]]\nname = \"small\"");
  EXPECT_EQ(numbers_of(scene_from(selected).analysis.pairs), numbers_of(alone.pairs))
      << "nor does a disk of another group";
}

TEST(AnalysisScene, TakesWhatIsSaid) {
  const Scene scene = scene_from(with("what = [\"density\", \"pair_correlation\"]\nevery = 0.5\nstart = 2.0\n"
                                      "density = { axis = \"x\", bins = 7 }\npair_correlation = { r_max = 1.5 }"),
                                 {{"analysis.density.bins", "8"}});
  EXPECT_EQ(scene.analysis.every, 0.5);
  EXPECT_EQ(scene.analysis.start, 2.0);
  EXPECT_TRUE(scene.analysis.density_along_x);
  EXPECT_EQ(scene.analysis.density_bins, 8U);
  EXPECT_EQ(scene.analysis.pairs.r_max, 1.5);
  EXPECT_EQ(resolved_toml(scene_from(test::sound_scene)).find("analysis"), std::string::npos);
}

TEST(AnalysisScene, SamplesComeWithTheFramesWhereThereAreAny) {
  EXPECT_EQ(scene_from(with("what = [\"speeds\"]\n[output]\nevery = 0.7\nseries = true")).analysis.every, 0.7);
}

// One sample, at the end; the largest number of bins; and rows that start with the first sample.
TEST(AnalysisScene, TakesAllUpToItsBounds) {
  for (const char* const most : {"what = []\nstart = 10.0", "what = [\"density\"]\ndensity = { bins = 100000 }",
                                 "what = [\"density\"]\nstart = 5.0\ndensity = { every = 6e-5 }"}) {
    EXPECT_EQ(complaint(with(most)), "") << most;
  }
}

TEST(AnalysisScene, OneLineForWhatItDoesNotTake) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"every = 1.0",
       "gas.toml:24: analysis.what: missing; expected a list of what to measure, as in "
       "[\"pair_correlation\"]"},
      {"what = \"speeds\"", "analysis.what: is a string; expected a list of what to measure"},
      {"what = [\"structure_factor\"]", "analysis.what: structure_factor needs waves along periodic sides, and no"},
      {"what = [\"profile\"]\nprofile = { bins = 0 }",
       "analysis.profile.bins: is 0; expected a whole number from 1 to"},
      {"what = [\"speeds\"]\nprofile = { bins = 3 }", "analysis.profile: has options, but what does not contain it"},
      {"what = [\"profile\"]\nprofile = { axis = \"z\" }", "analysis.profile.axis: unknown name \"z\""},
      {"what = [\"speed\"]",
       "gas.toml:25: analysis.what.0: unknown quantity \"speed\"; expected one of "
       "pair_correlation, displacement, speeds, density, pressure, collision_rate, profile, "
       "velocity_autocorrelation, structure_factor, bond_order, bond_correlation, bond_autocorrelation "
       "(nearest: speeds)"},
      {"what = []\nevry = 1.0", "analysis.evry: unknown key"},
      {"what = []\nevery = -1", "analysis.every: is -1"},
      {"what = []\nstart = 11", "analysis.start: is 11, after the end of the run; expected at most run.t_end = 10"},
      {"what = []\ndensity = { bins = 3 }",
       "analysis.density: has options, but what does not contain it; expected \"density\" in what"},
      {"what = [\"density\"]\ndensity = { bins = 0 }",
       "analysis.density.bins: is 0; expected a whole number from 1 to "
       "100000"},
      {"what = [\"density\"]\ndensity = { axis = \"z\" }", "analysis.density.axis: "},
      {"what = [\"density\"]\ndensity = { every = 0 }", "analysis.density.every: is 0"},
      {"what = [\"profile\"]\nprofile = { every = 1e-6 }",
       "analysis.profile.every: is 1e-06, which makes 1e+07 rows; expected at least 0.0001, for 100000 rows"},
      {"what = [\"pair_correlation\"]\npair_correlation = { groups = [\"heavy\"] }",
       "analysis.pair_correlation.groups.0: "},
      {"what = [\"pair_correlation\"]\npair_correlation = { groups = 3 }",
       "analysis.pair_correlation.groups: is an integer; expected a list of the names of groups"},
      {"what = [\"bond_correlation\"]\nbond_correlation = { r_max = 4.5 }",
       "gas.toml:26: analysis.bond_correlation.r_max: 4.5 is too large for the box; expected at most 3.99"},
      {"what = [\"density\"]\ndensity = \"x\"",
       "analysis.density: is a string; expected a table with axis, bins, every"},
      {"what = [\"speeds\"]\nspeeds = { max = 0 }", "analysis.speeds.max: is 0"},
      {"what = [\"pair_correlation\"]\npair_correlation = { r_max = 4.5 }",
       "gas.toml:26: analysis.pair_correlation.r_max: 4.5 is too large for the box; expected at most 3.99"},
  };
  for (const auto& [lines, expected] : cases) EXPECT_THAT(complaint(with(lines)), HasSubstr(expected)) << lines;
}

TEST(AnalysisScene, PairsAreCountedUpToHalfAPeriod) {
  const std::string periodic = test::replaced(
      test::replaced(with("what = [\"pair_correlation\"]\npair_correlation = { r_max = 5.5 }"), "left = \"wall\"",
                     "left = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\""),
      "right = \"wall\"", "right = \"periodic\"");
  EXPECT_THAT(complaint(periodic),
              HasSubstr("5.5 is too large for the box; expected at most 5, half the shorter side"));
  EXPECT_EQ(complaint(periodic, {{"analysis.pair_correlation.r_max", "5"}}), "");
}

}  // namespace
}  // namespace carom
