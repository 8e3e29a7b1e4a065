// A summary as JSON and as a table: each number under its own name.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "run/results/summary.hpp"

namespace carom {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

Summary hundred_steps() {
  Summary s;
  s.scene = "gas.toml";
  s.method = "pairwise";
  s.engine = {"parallel", 2};
  s.particles = 7;
  s.time = 5.0;
  s.counters.steps = 100;
  s.counters.collisions = 30;
  s.counters.wall_collisions = 40;
  s.step_s = 0.5;
  s.mean_disks = 10.0;
  s.collision_rate = 0.25;
  s.state_hash = "00ff";
  return s;
}

json parsed(const Summary& s) {
  return json::parse(json_text(s));
}

TEST(SummaryText, OfSidesOnlyThoseThatGiveAnything) {
  Summary s = hundred_steps();
  for (std::size_t k = 0; k < 4; ++k) s.counters.side_energy[k] = 1.0 + static_cast<double>(k);
  json all = parsed(s);
  for (const char* const key : {"heat", "work", "wall_work", "wall_push", "thermostat_heat", "shear_work", "removed_by",
                                "traffic", "resume_with"}) {
    EXPECT_FALSE(all.contains(key)) << key;
  }
  s.box.temperatures[1] = 1.0;
  s.box.motions[2].kind = SideMotion::Kind::steady;
  s.box.inner_walls_move = true;
  s.box.shear.rate = 0.5;
  s.thermostat = true;
  s.counters.wall_work = 5.0;
  s.counters.wall_push[0] = 6.0;
  s.counters.wall_push[1] = 7.0;
  s.counters.thermostat_heat = 8.0;
  s.counters.shear_work = 9.0;
  s.removed_by = {{"left", 10}, {"walls.2", 0}};
  s.resume_with = "carom resume out";
  all = parsed(s);
  EXPECT_EQ(all["heat"], (json{{"right", 2.0}}));
  EXPECT_EQ(all["work"], (json{{"bottom", 3.0}}));
  EXPECT_EQ(all["wall_work"], 5.0);
  EXPECT_EQ(all["wall_push"], (json{6.0, 7.0}));
  EXPECT_EQ(all["thermostat_heat"], 8.0);
  EXPECT_EQ(all["removed_by"], (json{{"left", 10}, {"walls.2", 0}}));
  EXPECT_EQ(all["shear_work"], 9.0);
  EXPECT_EQ(all["resume_with"], "carom resume out");
}

TEST(SummaryText, WhatAnAnalysisMeasuredHasItsError) {
  Summary s = hundred_steps();
  EXPECT_FALSE(parsed(s).contains("analysis"));
  EXPECT_THAT(table_text(s, ""), Not(HasSubstr("measured")));
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  s.measured = {{"pressure", 0.5, 0.0123}, {"collision_rate", 2.0, nothing}, {"diffusion", nothing, nothing}};
  EXPECT_EQ(parsed(s)["analysis"], (json{{"pressure", 0.5},
                                         {"pressure_error", 0.0123},
                                         {"collision_rate", 2.0},
                                         {"collision_rate_error", nullptr},
                                         {"diffusion", nullptr},
                                         {"diffusion_error", nullptr}}));
  EXPECT_THAT(
      table_text(s, ""),
      HasSubstr(
          "  measured    pressure 0.5 +- 0.012, collision_rate 2, diffusion unknown, as there are too few samples\n"));
  s.measured = {{"pressure", nothing, nothing, "Brownian disks have no velocities"}};
  EXPECT_THAT(table_text(s, ""), HasSubstr("  measured    pressure unknown, as Brownian disks have no velocities\n"));
}

TEST(SummaryText, WhatWasWorstHasItsTimeAndItsDisks) {
  Summary s = hundred_steps();
  json all = parsed(s);
  EXPECT_EQ(all["worst_overlap_ids"], json::array());
  EXPECT_EQ(all["worst_wall_overlap_ids"], json::array());
  EXPECT_THAT(table_text(s, ""), HasSubstr("at most 0 of two disks, 0 with a wall\n"));
  s.max_overlap = 0.01;
  s.wall_overlap = 0.02;
  s.worst_disks = {{0.125, 3, 8}, 1.5};
  s.worst_wall = {{0.25, 4, 9}, 2.5};
  all = parsed(s);
  EXPECT_EQ(all["max_overlap"], 0.01);
  EXPECT_EQ(all["wall_overlap"], 0.02);
  EXPECT_EQ(all["worst_overlap"], 0.125);
  EXPECT_EQ(all["worst_overlap_time"], 1.5);
  EXPECT_EQ(all["worst_overlap_ids"], (json{3, 8}));
  EXPECT_EQ(all["worst_wall_overlap"], 0.25);
  EXPECT_EQ(all["worst_wall_overlap_time"], 2.5);
  EXPECT_EQ(all["worst_wall_overlap_ids"], json::array({4}));
  EXPECT_THAT(table_text(s, ""), HasSubstr("at most 0.12 of two disks at time 1.5, 0.25 with a wall at time 2.5\n"));
}

TEST(SummaryText, TheTableHasALineForWhatThereWas) {
  Summary s = hundred_steps();
  std::string text = table_text(s, "");
  EXPECT_THAT(text, testing::StartsWith("gas.toml: pairwise, parallel engine, 2 threads, seed 1\n"));
  EXPECT_THAT(text, HasSubstr("  disks       7\n"));
  EXPECT_THAT(text, HasSubstr("  time        5 in 100 steps\n"));
  EXPECT_THAT(text, HasSubstr("30 of disks, 40 with walls; 0.25 per disk and unit time\n"));
  EXPECT_THAT(text, HasSubstr("  speed       200 steps/s, 2 k disk-steps/s; "));
  for (const char* const absent : {"momentum", "resumed", "results", "ranks", "sinks", "sources", "room"}) {
    EXPECT_THAT(text, Not(HasSubstr(absent)));
  }
  s.counters.removed = s.counters.emitted = s.counters.waiting = 1;
  s.keeps_momentum = true;
  s.momentum_drift = 0.5;
  s.resumed = 1;
  s.title = "a gas";
  text = table_text(s, "out/gas");
  EXPECT_THAT(text, testing::StartsWith("a gas: "));
  EXPECT_THAT(text, HasSubstr("  disks       7, 1 left through sinks, 1 came from sources, 1 wait for room\n"));
  EXPECT_THAT(text, HasSubstr("  momentum    changed by 0.5 of sum m |v|\n"));
  EXPECT_THAT(text, HasSubstr("  resumed     once\n"));
  EXPECT_THAT(text, HasSubstr("  results     out/gas\n"));
  s.resumed = 2;
  EXPECT_THAT(table_text(s, ""), HasSubstr("  resumed     2 times\n"));
  s.drawn_velocities = true;
  text = table_text(s, "");
  EXPECT_THAT(text, Not(HasSubstr("  energy ")));
  EXPECT_THAT(text, Not(HasSubstr("  pressure ")));
}

// Traffic is the mean for a step and a rank.
TEST(SummaryText, TrafficIsThatOfAStepAndARank) {
  Summary s = hundred_steps();
  s.engine.ranks = 2;
  RankReport& report = s.ranks.emplace();
  report.steps = 5;
  report.ranks.resize(2);
  report.ranks[0] = {4, 10, 1000, {{10, 100}, {20, 200}, {30, 300}, 1.5}};
  report.ranks[1] = {2, 11, 2000, {{30, 300}, {40, 400}, {50, 500}, 2.5}};
  const json traffic = parsed(s)["traffic"];
  EXPECT_EQ(traffic["disks"], (json{4, 2}));
  EXPECT_EQ(traffic["ghosts"], (json{10, 11}));
  EXPECT_EQ(traffic["peak_bytes"], (json{1000, 2000}));
  EXPECT_EQ(traffic["seconds"], (json{1.5, 2.5}));
  EXPECT_DOUBLE_EQ(traffic["imbalance"], 4.0 / 3.0);
  EXPECT_EQ(traffic["exchange"], (json{{"messages", 4.0}, {"bytes", 40.0}}));
  EXPECT_EQ(traffic["all_reduce"], (json{{"messages", 6.0}, {"bytes", 60.0}}));
  EXPECT_EQ(traffic["gather"], (json{{"messages", 8.0}, {"bytes", 80.0}}));
  const std::string text = table_text(s, "");
  EXPECT_THAT(text, HasSubstr("2 threads on each of 2 ranks"));
  EXPECT_THAT(text, HasSubstr("2 to 4 disks each; 18.0 messages with 180B per step and rank; "));
}

TEST(SummaryText, ThePressureOrWhyThereIsNone) {
  Summary s = hundred_steps();
  s.pressure = 0.0734;
  EXPECT_THAT(table_text(s, ""), HasSubstr("  pressure    0.0734\n"));
  s.pressure = std::nan("");
  s.kinetic_initial = 1.0;
  s.kinetic_final = 2.0;
  EXPECT_THAT(table_text(s, ""), HasSubstr("unknown from the kinetic energy of 1 at the start and 2 at the end; "));
  EXPECT_TRUE(parsed(s)["pressure"].is_null());
  s.box.shear.rate = 0.5;
  EXPECT_THAT(table_text(s, ""),
              HasSubstr("unknown from the kinetic energy relative to the flow of 1 at the start and 2 at the end; "));
  s.counters.steps = 0;
  EXPECT_THAT(table_text(s, ""), HasSubstr("unknown, as no time has passed"));
}

}  // namespace
}  // namespace carom
