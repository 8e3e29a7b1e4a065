// sweep.csv: heat, work, the disks taken by each sink, and means of an analysis have columns if runs have them. A sweep
// over the speed of a piston once showed no work.
#include "app/sweep/sweep_table.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

// The part of each line after the hash.
std::vector<std::string> ends(const std::vector<SweepRow>& rows) {
  std::vector<std::string> found;
  std::istringstream text(sweep_table({SweepAxis{"seed_of_run", {}}}, rows));
  for (std::string line; std::getline(text, line);) {
    const std::size_t hash = line.find(found.empty() ? "state_hash" : "#");
    found.push_back(line.substr(hash + (found.empty() ? 10 : 1)));
  }
  return found;
}

TEST(SweepTable, HasHeatAndWorkWhereARunHasThem) {
  const SweepRun run{"0001", {{"seed_of_run", "1"}, {"seed", "1"}}};
  const Json plain = {{"state_hash", "#"}};
  EXPECT_THAT(ends({{&run, plain}}), testing::ElementsAre("", ""));
  Json piston = plain;
  piston["heat"] = {{"left", -2.5}};
  piston["work"] = {{"right", 1.5}, {"top", 0.0}};
  Json bath = plain;
  bath["thermostat_heat"] = 0.25;
  bath["work"] = {{"right", nullptr}};
  EXPECT_THAT(
      ends({{&run, plain}, {&run, piston}, {&run, bath}}),
      testing::ElementsAre(",heat_left,thermostat_heat,work_right,work_top", ",,,,", ",-2.5,,1.5,0.0", ",,0.25,,"));
}

TEST(SweepTable, HasWhatEachSinkTookWhereARunHasSinks) {
  const SweepRun run{"0001", {{"seed_of_run", "1"}, {"seed", "1"}}};
  Json open = {{"state_hash", "#"}};
  open["removed_by"] = {{"left", 3}, {"walls.2", 0}};
  EXPECT_THAT(ends({{&run, open}}), testing::ElementsAre(",removed_by_left,removed_by_walls.2", ",3,0"));
}

TEST(SweepTable, HasWhatAnAnalysisMeasuredWhereARunHasOne) {
  const SweepRun run{"0001", {{"seed_of_run", "1"}, {"seed", "1"}}};
  Json fluid = {{"state_hash", "#"}};
  fluid["analysis"] = {{"diffusion", 0.5}, {"diffusion_error", nullptr}};
  EXPECT_THAT(ends({{&run, fluid}}), testing::ElementsAre(",analysis_diffusion,analysis_diffusion_error", ",0.5,"));
}

}  // namespace
}  // namespace carom
