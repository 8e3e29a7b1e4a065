// carom chart --scene: the speed-accuracy chart of a user's own scene, and refused scenes.
#include "tests/support/command_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;
using test::text_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* gas = R"(title = "it's mine"
seed = 11
[box]
packing_fraction = 0.4
left = "periodic"
right = "periodic"
[[disks]]
count = 64
positions = "random"
velocities = { maxwell = 1.0 }
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.003
t_end = 3.0
)";

class ChartOwn : public test::CommandTest {
 protected:
  ChartOwn() { write("my.gas.toml", gas); }
  void expect_refusal(const std::string& changes, const std::string& what) const {
    expect_error("$C chart --tiny --scene my.gas.toml " + changes, 2, what);
  }
};

TEST_F(ChartOwn, HasAllMethodsTheOwnStepAndATable) {
  const Outcome o = carom("chart --tiny --scene my.gas.toml");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, IsEmpty());
  EXPECT_THAT(files_in("out/chart_my.gas"), ElementsAre("chart.csv", "chart.json", "chart.png", "chart.svg"));
  const Json j = Json::parse(text_of(at("out/chart_my.gas/chart.json")));
  ASSERT_EQ(j["scenes"].size(), 1U);
  EXPECT_EQ(j["scenes"][0]["scene"], "my.gas");
  EXPECT_EQ(j["scenes"][0]["title"], "it's mine");
  EXPECT_EQ(j["seeds"], "11 to 12") << "the scene's own seed and the next";
  EXPECT_THAT(j["scenes"][0]["text"].get<std::string>(), HasSubstr("seed = 11"));
  const std::string csv = text_of(at("out/chart_my.gas/chart.csv"));
  for (const char* const row : {"\nmy.gas,rollback,0.003,", "\nmy.gas,pairwise,0.003,", "\nmy.gas,exact,0,"}) {
    EXPECT_THAT(csv, HasSubstr(row));
  }
  EXPECT_THAT(o.out, HasSubstr("the scene's dt"));
  EXPECT_THAT(o.out, HasSubstr("for a path error of 0.01: "));
  EXPECT_THAT(o.out, HasSubstr("out/chart_my.gas/chart.svg after "));
  expect_error("$C chart --tiny --scene my.gas.toml", 2, "chart.svg: exists already");
}

// After all runs it once ended with an error of the JSON library, and without pictures.
TEST_F(ChartOwn, ASceneOfAnyNameHasItsChart) {
  write("\"b\344d\".toml", gas);
  const Outcome o = shell("$C chart --tiny --scene '\"b\344d\".toml' -o odd");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(files_in("odd"), ElementsAre("chart.csv", "chart.json", "chart.png", "chart.svg"));
  EXPECT_EQ(Json::parse(text_of(at("odd/chart.json")))["scenes"][0]["scene"], "_b\357\277\275d_");
  EXPECT_THAT(text_of(at("odd/chart.csv")), HasSubstr("\n_b\344d_,exact,0,"));
}

// A flow heats what collisions cool, so there is no cooling rate.
TEST_F(ChartOwn, ADissipativeShearFlowHasAPressure) {
  const std::string periodic = " --set 'box.bottom=\"periodic\"' --set 'box.top=\"periodic\"'";
  const std::string words = "chart --tiny --scene my.gas.toml --set physics.restitution=0.9" + periodic;
  const Outcome cooling = carom(words + " -o cooling");
  ASSERT_EQ(cooling.status, 0) << cooling.err;
  EXPECT_THAT(cooling.out, HasSubstr("collision rate and cooling to"));
  const Outcome sheared = carom(words + " --set box.shear_rate=1.0 -o sheared");
  ASSERT_EQ(sheared.status, 0) << sheared.err;
  EXPECT_THAT(sheared.out, HasSubstr("collision rate and pressure to"));
}

// Paths are compared until a disk has collided twice on average, and rates until it has collided 25 times.
TEST_F(ChartOwn, TimesAreThoseOfSoManyCollisions) {
  const Outcome o = carom("chart --tiny --scene my.gas.toml --t-end 30 -o long");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json planned = Json::parse(text_of(at("long/chart.json")))["scenes"][0];
  const auto collisions_a_disk_by = [&](double time) {
    const Outcome run =
        carom("run my.gas.toml --method exact --json --quiet --force -o run --t-end " + std::to_string(time));
    return 2.0 * Json::parse(run.out)["collisions"].get<double>() / 64.0;
  };
  EXPECT_NEAR(collisions_a_disk_by(planned["flight"]), 2.0, 0.2);
  EXPECT_NEAR(collisions_a_disk_by(planned["length"]), 25.0, 1.0);
}

// Two disks on a line and no random numbers: one run is enough, without a standard error.
TEST_F(ChartOwn, AStartWithoutChanceIsRunOnce) {
  write("two.toml", R"([box]
width = 10.0
height = 10.0
[[disks]]
count = 2
positions = [[2.0, 5.0], [6.0, 5.3]]
velocities = [[1.0, 0.0], [0.0, 0.0]]
radius = 0.5
mass = 1.0
[run]
method = "exact"
t_end = 20.0
)");
  const Outcome o = carom("chart --tiny --scene two.toml -o two");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(Json::parse(text_of(at("two/chart.json")))["seeds"], "1");
  const std::string csv = text_of(at("two/chart.csv"));
  EXPECT_THAT(csv, HasSubstr("\ntwo,exact,0,1,"));
  EXPECT_THAT(csv, ::testing::Not(HasSubstr("two,pairwise,0.2,2,")));
  std::istringstream rows(csv);
  int known = 0;
  for (std::string row; std::getline(rows, row);) {
    std::istringstream cells(row);
    std::string cell;
    for (int column = 0; column < 8; ++column) std::getline(cells, cell, ',');
    EXPECT_EQ(cell, row.starts_with("scene,") ? "standard_error" : "0") << row;
    known += cell == "0" ? 1 : 0;
  }
  EXPECT_GT(known, 10);
}

// Energy and momentum taken by an inner wall are not errors of a method.
TEST_F(ChartOwn, AnInnerWallTakesEnergyAndMomentum) {
  write("wall.toml", std::string(gas) + R"([[walls]]
from = [2.0, 1.0]
to = [9.0, 1.0]
restitution = 0.5
)");
  const Outcome o = carom("chart --tiny --scene wall.toml --set box.bottom=periodic --set box.top=periodic -o wall");
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string csv = text_of(at("wall/chart.csv"));
  EXPECT_THAT(csv, HasSubstr(",path,"));
  EXPECT_EQ(csv.find(",energy,"), std::string::npos) << csv;
  EXPECT_EQ(csv.find(",momentum,"), std::string::npos) << csv;
}

// Paths are those of moving disks: fixed disks count neither against the limit for paths, nor as colliding disks.
TEST_F(ChartOwn, FixedDisksAreNotCounted) {
  const std::string pegs =
      "[[disks]]\nfixed = true\ncount = 21000\npositions = \"random\"\nradius = 1e-6\nregion = [0.0, 0.0, 0.1, 0.1]\n";
  write("pegs.toml", gas + pegs);
  expect_error("$C chart --tiny --scene pegs.toml --t-end 0.0001", 2, "cannot be charted: no two disks collide by");
  const std::string changes = "--set disks.0.count=1 --set 'disks.0.velocities={ uniform = 1.0 }'";
  expect_error("$C chart --tiny --scene pegs.toml --set box.packing_fraction=0.01 " + changes, 2,
               "cannot be charted: nothing collides; expected two disks or more");
}

// Fixed disks that are listed first have the first ids.
TEST_F(ChartOwn, FixedDisksMayComeFirst) {
  const std::string all = gas;
  const std::size_t disks = all.find("[[disks]]");
  const std::string pegs = "[[disks]]\nfixed = true\ncount = 30\npositions = \"hexagonal\"\nradius = 0.05\n";
  write("pegs_first.toml", all.substr(0, disks) + pegs + all.substr(disks));
  const Outcome o = carom("chart --tiny --scene pegs_first.toml -o pegs_first");
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string csv = text_of(at("pegs_first/chart.csv"));
  std::istringstream rows(csv);
  double exact = 1.0;
  for (std::string row; std::getline(rows, row);) {
    const std::size_t path = row.find(",path,");
    if (row.find(",exact,0,") != std::string::npos && path != std::string::npos)
      exact = std::stod(row.substr(path + 6));
  }
  EXPECT_LT(exact, 1e-6) << csv;
}

TEST_F(ChartOwn, BrownianMotionHasItsOwnFigure) {
  const Outcome o = carom("chart --tiny --scene my.gas.toml --set physics.diffusion=0.5 -o brownian");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("collision rate and spread to t = "));
}

TEST_F(ChartOwn, WhatCannotBeChartedIsRefusedWithTheRemedy) {
  expect_refusal("--set box.bottom='\"sink\"'",
                 "my.gas.toml: cannot be charted: sinks remove disks; expected the same");
  expect_refusal("--set disks.0.count=1 --set box.packing_fraction=0.1 --set 'disks.0.velocities={ uniform = 1.0 }'",
                 "cannot be charted: nothing collides; expected two disks or more");
  expect_refusal("--t-end 0.0001", "no two disks collide by t = 0.0001; expected a longer run (--t-end)");
  expect_refusal("--t-end 0", "t_end is 0");
  expect_refusal("--set physics.diffusion=1.0 --set physics.accumulate=true", "the step is part of the physics");
  expect_refusal("--set disks.0.count=30000 --set box.packing_fraction=0.3", "30000 disks are too many to compare");
  write("fall.toml", R"([box]
width = 10.0
height = 10.0
wall_restitution = 0.5
[physics]
gravity = 1.0
[[disks]]
count = 2
positions = [[3.0, 4.0], [7.0, 4.0]]
radius = 0.5
mass = 1.0
[run]
method = "exact"
t_end = 100.0
)");
  expect_error("$C chart --tiny --scene fall.toml", 2, "fall.toml: cannot be charted: exact, which all others are");
  expect_error("$C chart --scene missing.toml", 2, "missing.toml: ");
  expect_error("$C chart --t-end 5", 2,
               "chart: changes of a scene are given, but no scene; expected --scene SCENE.toml");
  EXPECT_THAT(files_in(""), ElementsAre("fall.toml", "my.gas.toml", "small.toml")) << "nothing is left behind";
}

}  // namespace
}  // namespace carom
