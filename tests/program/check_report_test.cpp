// The report of carom check: the physics of a scene, its steps, and files whose sizes are only guessed.
#include <cmath>
#include <string>

#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;

// Two disks, the heavy one first.
constexpr const char* two_disks = R"([box]
width = 10.0
height = 10.0
[physics]
gravity = 1.0
[[disks]]
name = "heavy"
count = 1
positions = [[5.0, 8.5]]
radius = 0.5
mass = 3.0
[[disks]]
name = "light"
count = 1
positions = [[2.0, 2.0]]
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 10.0
[output]
every = 0.1
)";

class CheckReport : public test::CommandTest {
 protected:
  CheckReport() { write("two.toml", two_disks); }
  std::string said(const std::string& options) const {
    const Outcome o = carom("check two.toml " + options);
    EXPECT_EQ(o.status, 0) << o.err;
    return o.err + o.out;
  }
  Json json(const std::string& options, const std::string& scene = "two.toml", const std::string& before = "") const {
    const Outcome o = shell(before + "$C check " + scene + " --json " + options);
    EXPECT_EQ(o.status, 0) << o.err;
    return Json::parse(o.out);
  }
};

TEST_F(CheckReport, ThePhysicsIsInWords) {
  EXPECT_THAT(said(""), HasSubstr("mass 1 to 3\n"));
  EXPECT_THAT(said(""), HasSubstr("gravity 1 downwards; elastic collisions, at walls too\n"));
  EXPECT_THAT(said("--set 'physics.gravity=[0.5, -2]'"), HasSubstr("gravity [0.5, -2]; "));
  EXPECT_THAT(said("--set 'physics.gravity=[0, 2]'"), HasSubstr("gravity [0, 2]; ")) << "upwards";
  EXPECT_THAT(said("--set physics.restitution=0.5"), HasSubstr("; restitution 0.5 of disks, 1 at walls\n"));
  EXPECT_THAT(said("--set box.wall_restitution=0.5"), HasSubstr("; elastic collisions, 0.5 at walls\n"));
  EXPECT_THAT(said("--method exact --set physics.restitution=0.5 --set 'physics.collapse={ model = \"tc\", "
                   "contact_time = 1e-6 }'"),
              HasSubstr("; the TC model, contact time 1e-06\n"));
}

// A run counts more steps than dt gives if windows of exact end before a draw, or if frames of rollback are cut short.
TEST_F(CheckReport, StepsAreWhatDtTells) {
  EXPECT_THAT(said(""), HasSubstr("  method      pairwise, dt = 0.01, 1000 steps to t = 10\n"));
  EXPECT_THAT(said("--method rollback"), HasSubstr("rollback, dt = 0.01, 1000 steps or more to t = 10\n"));
  EXPECT_THAT(said("--method exact --set physics.diffusion=0.1 --set physics.gravity=0"),
              HasSubstr("exact, dt = 0.01, 1000 draws to t = 10\n"));
}

TEST_F(CheckReport, FixedDisksAndInnerWallsAreCounted) {
  EXPECT_THAT(said("--set 'walls=[{ from = [1, 1], to = [2, 1] }]'"), HasSubstr(", top wall; 1 inner wall\n"));
  EXPECT_THAT(said("--set 'walls=[{ from = [1, 1], to = [2, 1] }, { from = [1, 2], to = [2, 2], kind = \"sink\" }]'"),
              HasSubstr(", top wall; 2 inner walls, of which 1 sink\n"));
  write("fixed.toml",
        std::string(two_disks) + "[[disks]]\nfixed = true\ncount = 2\npositions = [[7, 7], [8, 8]]\nradius = 0.5\n");
  EXPECT_THAT(carom("check fixed.toml").out, HasSubstr("  disks       2, radius 0.5, mass 1 to 3; 2 fixed\n"));
  EXPECT_THAT(carom("check fixed.toml").out,
              HasSubstr("  box         10 x 10, packing fraction 0.01571, 0.03142 with fixed disks\n"));
  EXPECT_THAT(said(""), HasSubstr("  box         10 x 10, packing fraction 0.01571\n"));
}

TEST_F(CheckReport, AShearFlowIsInWords) {
  const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";
  write("sheared.toml",
        "[box]\nwidth = 10.0\nheight = 10.0\nshear_rate = -0.25\n" + periodic +
            "[[disks]]\ncount = 2\npositions = [[2, 2], [7, 7]]\nradius = 0.5\nmass = 1\n[run]\nt_end = 1.0\n");
  const Outcome o = carom("check sheared.toml");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("elastic collisions; a shear flow of rate -0.25\n"));
}

TEST_F(CheckReport, WhatALongStepLeadsToIsTold) {
  EXPECT_THAT(said("--dt 0.5 --set 'disks.0.velocities=[[1, 0]]'"), HasSubstr("safe step: steps will be split; use"));
  EXPECT_THAT(said("--dt 0.15 --set physics.diffusion=0.1"), HasSubstr("safe step: steps may be split; use"));
  const std::string fast = said("--dt 0.5 --set 'disks.0.velocities=[[1e4, 0]]'");
  EXPECT_THAT(fast, HasSubstr("safe step: the run will stop at once, with status 3; use"));
}

TEST_F(CheckReport, WhatARunWouldWarnOfIsSaid) {
  EXPECT_THAT(said("--set 'box.left={ motion = { vibrate = [0.01, 0.0], period = 0.001 } }'"),
              HasSubstr("carom: warning: a wall vibrates with a period of 0.001"));
  EXPECT_THAT(said("--set physics.restitution=0.9 --set 'physics.collapse={ model = \"tc\", contact_time = 1e-3 }'"),
              HasSubstr("carom: warning: two.toml: physics.collapse"));
}

// The fastest of n draws has m v^2 / 2 = T ln n: here mass 4, temperature 2, and nine disks before the end.
TEST_F(CheckReport, HeavyDisksOfAHotSourceAreSlow) {
  write("source.toml", R"([box]
width = 100.0
height = 100.0
[[sources]]
side = "left"
rate = 1.0
radius = 0.25
mass = 4.0
velocities = { maxwell = 2.0 }
[run]
method = "pairwise"
dt = 0.001
t_end = 10.0
)");
  EXPECT_NEAR(json("", "source.toml")["safe_dt"].get<double>(), 0.125 / std::sqrt(std::log(9.0)), 1e-9);
}

// A wall that is not horizontal sweeps over new places when it moves along x.
TEST_F(CheckReport, AWallThatMovesAlongItselfDoesNothing) {
  const std::string wall =
      "--set physics.gravity=0.0 --set box.left='\"periodic\"' --set box.right='\"periodic\"' --set "
      "'walls=[{ points = [[0, 5], [10, HEIGHT]], motion = { velocity = [1.0, 0.0] } }]'";
  const auto with_end_at = [&](const std::string& height) {
    return said(std::string(wall).replace(wall.find("HEIGHT"), 6, height));
  };
  EXPECT_THAT(with_end_at("5"), HasSubstr("walls.0 moves along itself but is smooth"));
  EXPECT_THAT(with_end_at("6"), Not(HasSubstr("moves along itself")));
}

// exact needs to see ten spacings and more beyond a slab, which is impossible if slabs are as thin as that.
TEST_F(CheckReport, ThatOneRankRunsAllDisksIsTold) {
  const auto troubles = [&](const char* height) {
    return json(std::string("--ranks 2 --method exact --t-end 0.2 --set physics.gravity=0 --set box.width=40 ") +
                "--set box.height=" + height + " --set 'disks=[{ count = 900, positions = \"square\", velocities = " +
                "{ maxwell = 1.0 }, radius = 0.5, mass = 1.0 }]'")["troubles"];
  };
  ASSERT_EQ(troubles("40").size(), 1U);
  EXPECT_THAT(troubles("40")[0].get<std::string>(),
              testing::ContainsRegex("^in ([0-9]+) of [0-9]+ steps? of a trial on 2 ranks one of them ran all disks"));
  EXPECT_EQ(troubles("400"), Json::array());
}

// A trial uses at most three ranks.
TEST_F(CheckReport, OnHowManyRanksItTriedIsTold) {
  const std::string tall = " --method pairwise --set physics.gravity=0 --set box.height=80";
  const Json two = json("--ranks 2" + tall)["ranks"], five = json("--ranks 5" + tall)["ranks"];
  EXPECT_EQ(two["tried"], 2);
  EXPECT_EQ(five["count"], 5);
  EXPECT_EQ(five["tried"], 3);
  EXPECT_THAT(said("--ranks 2" + tall), Not(HasSubstr("from a trial on")));
  EXPECT_THAT(said("--ranks 5" + tall), HasSubstr("per step, from a trial on 3\n"));
}

// Without ffmpeg and gnuplot the memory of ffmpeg and the plots must not be counted.
TEST_F(CheckReport, WhatARunLacksWithoutFfmpegAndGnuplot) {
  const Json j = json("--set output.movie=true --set output.plots='[\"energy\"]'", "two.toml", "PATH=/nonexistent ");
  EXPECT_EQ(j["troubles"], (Json{"ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on",
                                 "gnuplot is not installed: no plots are drawn"}));
  EXPECT_TRUE(j["files_bytes"].contains("frames"));
  EXPECT_FALSE(j["files_bytes"].contains("energy.svg"));
  EXPECT_EQ(j["cost_parts_s"]["plots"], 0.0);
}

// Sizes are guessed if no file can be written for the trial.
TEST_F(CheckReport, FilesAreGuessed) {
  const std::string all = "--set output.series=true --set output.movie=true --set output.trajectory='\"xyz\"'";
  const Json light = json(all + " --set output.select='\"light\"'", "two.toml", "TMPDIR=/nonexistent ")["files_bytes"];
  const Json both = json(all, "two.toml", "TMPDIR=/nonexistent ")["files_bytes"];
  for (const char* const file : {"series.csv", "movie.mp4", "trajectory.xyz"})
    EXPECT_TRUE(light.contains(file)) << file;
  EXPECT_EQ(2.0 * light["trajectory.xyz"].get<double>(), both["trajectory.xyz"].get<double>());
}

TEST_F(CheckReport, ACheckpointKeepsTheRoundsOfTrajectories) {
  const auto bytes = [&](const std::string& sides, const std::string& format) {
    return json("--set output.checkpoint=1000 --set output.trajectory='\"" + format + "\"' --set box.left='\"" + sides +
                "\"' --set box.right='\"" + sides + "\"'")["files_bytes"]["checkpoint.carom"]
        .get<double>();
  };
  EXPECT_EQ(bytes("periodic", "xyz"), bytes("wall", "xyz") + 2 * 8.0);
  EXPECT_EQ(bytes("periodic", "none"), bytes("wall", "none"));
}

TEST_F(CheckReport, EveryPartOfTheCostIsThere) {
  const Json j = json(
      "--set output.view=true --set output.trajectory='\"h5md\"' --set output.every=1e-7 --method exact "
      "--set 'analysis.what=[\"speeds\"]'");
  EXPECT_EQ(j["files_bytes"]["view.html"], 64e6) << "the page must not exceed this";
  EXPECT_GT(j["cost_parts_s"]["start"], 0.0);
  EXPECT_GT(j["cost_parts_s"]["analysis"], 0.0);
  EXPECT_GT(j["memory_bytes"], 4e6) << "no process takes less";
}

}  // namespace
}  // namespace carom
