// The predictions of carom check: collapse, speeds after a fall, disks from sources, and the size of every file.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/run/check_foresight.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::Outcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Check : public test::CommandTest {
 protected:
  Json check(const std::string& arguments) const {
    const Outcome o = carom("check " + arguments + " --json");
    EXPECT_EQ(o.status, 0) << o.err;
    return Json::parse(o.out);
  }
  static std::string troubles(const Json& j) {
    std::string all;
    for (const auto& trouble : j["troubles"]) all += trouble.get<std::string>() + "\n";
    return all;
  }
};
using LongCheck = Check;

// A disk of radius 0.5 at rest falls by 8 with g = 1: it lands at t = 4 with speed 4.
constexpr const char* falling_disk = R"([box]
width = 10.0
height = 10.0
wall_restitution = 0.5
[physics]
gravity = 1.0
[[disks]]
count = 1
positions = [[5.0, 8.5]]
radius = 0.5
mass = 1.0
[run]
method = "exact"
t_end = 100.0
)";

TEST_F(LongCheck, CollapseOnAFloorIsPredictedWithItsTime) {
  write("fall.toml", falling_disk);
  const Json j = check("fall.toml");
  EXPECT_EQ(j["collapse_expected"], true);
  // It lands at t = 4, and its flights then take 4, 2, 1, ...: it is at rest at t = 12.
  EXPECT_THAT(
      troubles(j),
      HasSubstr("inelastic collapse, infinitely many collisions in finite time, is expected from about t = 12 on"));
  EXPECT_THAT(carom("check fall.toml").out, HasSubstr("--method pairwise, or set physics.collapse"));
  const Outcome run = carom("run fall.toml");
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("inelastic collapse at t = 1"));

  EXPECT_EQ(check("fall.toml --t-end 10")["collapse_expected"], false) << "the run ends before the disk is at rest";
  EXPECT_EQ(check("fall.toml --set box.wall_restitution=1.0")["collapse_expected"], false);
  EXPECT_EQ(check("fall.toml --set box.bottom='\"sink\"'")["collapse_expected"], false);
  EXPECT_EQ(check("fall.toml --method pairwise --dt 0.01")["collapse_expected"], false);
  const std::string remedy = " --set 'physics.collapse={ model = \"tc\", contact_time = 1e-3 }'";
  EXPECT_EQ(check("fall.toml" + remedy)["collapse_expected"], false);
}

// If frames are more frequent than steps, a run has one frame for each step.
TEST_F(Check, NoMoreFramesThanStepsArePredicted) {
  write("fall.toml", falling_disk);
  const std::string often =
      "fall.toml --method pairwise --dt 0.01 --t-end 0.1 --set output.every=0.001 --set output.series=true";
  EXPECT_EQ(check(often)["frames"], 11);
  EXPECT_EQ(carom("run " + often + " --json").status, 0);
  EXPECT_EQ(check("fall.toml --t-end 0.1 --set output.every=0.001 --set output.series=true")["frames"], 101);
}

TEST_F(Check, CollapseOfAGasIsPredicted) {
  EXPECT_EQ(check("small.toml --method exact --set physics.restitution=0.4")["collapse_expected"], true);
  EXPECT_EQ(check("small.toml --method exact --set physics.restitution=0.95")["collapse_expected"], false);
}

TEST_F(Check, TheSafeStepIsThatAfterTheFall) {
  write("fall.toml", falling_disk);
  const Json j = check("fall.toml --method pairwise --dt 0.05 --set box.wall_restitution=1.0");
  EXPECT_NEAR(j["landing_speed"].get<double>(), 4.0, 1e-12);
  // dt follows from 4 dt + dt^2 = 0.25, half a radius.
  EXPECT_NEAR(j["safe_dt"].get<double>(), std::sqrt(4.25) - 2.0, 1e-9);
  EXPECT_THAT(j["troubles"], IsEmpty());
  const std::string longer = "fall.toml --method pairwise --dt 0.1";
  EXPECT_THAT(
      troubles(check(longer)),
      HasSubstr("longer than the safe step at the speeds that disks may reach: steps may be split; use dt <= "));
  EXPECT_THAT(carom("check " + longer).out, HasSubstr("0.0616 after falling (speed 4); dt is longer"));
  EXPECT_THAT(carom("run --quiet --json " + longer + " --t-end 5").out, HasSubstr("the step is split into 2 parts"));
  const std::string endless = "fall.toml --method pairwise --dt 600 --t-end 6e3";
  EXPECT_THAT(troubles(check(endless)), HasSubstr(": the run will stop at once, with status 3; use dt <= "));
  EXPECT_EQ(carom("run " + endless).status, 3);
}

TEST_F(Check, AnyStepIsSafeAtTheStartForDisksAtRest) {
  write("rest.toml", falling_disk);
  const std::string moved =
      "rest.toml --method pairwise --dt 1.0 --set physics.gravity=0.0 --set "
      "'box.left={ motion = { velocity = [0.01, 0.0] } }'";
  EXPECT_THAT(
      carom("check " + moved).out,
      HasSubstr("12.5 or less: any at the speeds of the start, 12.5 at the speeds that walls or a thermostat give"));
}

// In Brownian motion the velocities of the start are not used, and exact splits no step: check warns of the same dt as
// the run, sqrt(2 D dt) = half a radius; for pairwise three times the left side must be below half a radius.
TEST_F(Check, ABrownianStepIsNoFasterForTheVelocitiesOfTheStart) {
  const std::string brownian = "small.toml --set physics.diffusion=0.5 --set disks.0.radius=0.4 ";
  const std::string fast = "--set disks.0.velocities='{ uniform = 50.0 }' ";
  for (const std::string& set : {std::string(), fast}) {
    const std::string exact = brownian + set + "--method exact ";
    EXPECT_NEAR(check(exact + "--dt 0.039")["safe_dt"].get<double>(), 0.04, 1e-12);
    EXPECT_THAT(check(exact + "--dt 0.039")["troubles"], IsEmpty());
    EXPECT_THAT(carom("run " + exact + "--dt 0.039 -o under --force").err, IsEmpty());
    EXPECT_THAT(troubles(check(exact + "--dt 0.041")), HasSubstr("collisions of Brownian disks will be wrong"));
    EXPECT_THAT(carom("run " + exact + "--dt 0.041 -o over --force").err, HasSubstr("collisions are wrong"));
    EXPECT_NEAR(check(brownian + set + "--dt 0.001")["safe_dt"].get<double>(), 0.04 / 9.0, 1e-12);
  }
}

// Nothing moves at the start, but walls and thermostats will make disks move: the safe step is 0.25, half a radius,
// over the speed that they give.
TEST_F(LongCheck, WallsAndBathsAskForShorterSteps) {
  write("rest.toml", falling_disk);
  const std::string rest =
      "rest.toml --method pairwise --dt 1.0 --t-end 10 --set physics.gravity=0.0 --set physics.restitution=0.9";
  EXPECT_THAT(carom("check " + rest).out, HasSubstr("any: nothing moves"));
  const auto safe = [&](const std::string& set) {
    const Json j = check(rest + " --set '" + set + "'");
    EXPECT_THAT(troubles(j), HasSubstr("dt = 1 is longer than the safe step")) << set;
    return j["safe_dt"].get<double>();
  };
  EXPECT_NEAR(safe("box.left={ motion = { velocity = [0.2, 0.0] } }") * 0.4, 0.25, 1e-12);
  EXPECT_NEAR(safe("box.left={ motion = { vibrate = [0.5, 0.0], period = 1.0 } }") * 8.0, 0.25, 1e-12);
  EXPECT_NEAR(safe("box.left={ temperature = 2.0 }") * std::sqrt(4.0 * std::log(2.0)), 0.25, 1e-12);
  const std::string bath = "physics.thermostat={ kind = \"langevin\", temperature = 2.0, rate = 0.1, dt = 1.0 }";
  EXPECT_NEAR(safe(bath) * std::sqrt(4.0 * std::log(2.0)), 0.25, 1e-12);
  EXPECT_THAT(carom("check " + rest + " --set 'box.left={ temperature = 2.0 }'").out,
              HasSubstr("at the speeds that walls or a thermostat give; dt is longer"));
}

TEST_F(Check, APileAsksForAShorterStepThanItsSpeedsDo) {
  write("fall.toml", falling_disk);
  // The disk lies on the floor already: dt = sqrt(0.02 r / g) gives the largest overlap of a pile, 2 %.
  const Json j = check("fall.toml --method pairwise --dt 0.2 --set disks.0.positions='[[5.0, 0.5]]'");
  EXPECT_NEAR(j["safe_dt"].get<double>(), 0.1, 1e-9);
  EXPECT_THAT(troubles(j), HasSubstr("in a pile a disk falls by g dt^2 before it is held"));
  EXPECT_THAT(carom("check fall.toml --dt 0.1 --t-end 1 --method pairwise").out, HasSubstr("lie in a pile"));
  EXPECT_THAT(carom("check fall.toml --dt 0.1 --t-end 1 --method exact").out, Not(HasSubstr("lie in a pile")));
}

TEST_F(LongCheck, SourcesAddDisksSpeedsAndMemory) {
  write("source.toml", R"([box]
width = 100.0
height = 100.0
[[sources]]
side = "left"
rate = 50.0
radius = 0.25
mass = 1.0
velocities = { uniform = 20.0 }
[run]
method = "pairwise"
dt = 0.001
t_end = 1000.0
)");
  const Json j = check("source.toml");
  EXPECT_EQ(j["particles"], 0);
  EXPECT_EQ(j["particles_at_end"], 49999) << "no disk comes exactly at the end";
  EXPECT_NEAR(j["safe_dt"].get<double>(), 0.125 / (20.0 * std::sqrt(2.0)), 1e-9);
  EXPECT_THAT(troubles(j), HasSubstr("the sources would fill the box to a packing fraction of 0.98"));
  EXPECT_GT(j["cost_parts_s"]["steps"].get<double>(), 10.0) << "25000 disks on average, a million steps";
  const Json few = check("source.toml --set sources.0.limit=100");
  EXPECT_TRUE(few["particles_at_end"] == 100 && few["troubles"].empty()) << few;
  EXPECT_GT(j["memory_bytes"], few["memory_bytes"].get<double>() + 1e6);
  const std::string flow = carom("check source.toml --set box.right=sink").out;
  EXPECT_THAT(flow, testing::ContainsRegex(
                        "with those from sources up to 49999 at t = 1000(.|\n)*cost .*; less if sinks remove disks"));
}

// There is room for one disk. The trial, which comes to the end here, must report what the run reports.
TEST_F(Check, SourcesWithoutRoomAreSeenInTheTrial) {
  const std::string source = "[[sources]]\nregion = [4.9, 4.9, 5.1, 5.1]\nrate = 20\nradius = 0.5\nmass = 1\n";
  write("blocked.toml", test::replaced(test::small_scene, "[run]", source + "[run]"));
  const Json run = Json::parse(carom("run blocked.toml --json -o out").out);
  const std::string waits = run["warnings"][0].get<std::string>();
  EXPECT_THAT(waits, HasSubstr(fmt::format("{} of the ", run["waiting"].get<int>())));
  EXPECT_THAT(troubles(check("blocked.toml")), HasSubstr("tried up to" + waits.substr(waits.find(" time"))));
  EXPECT_THAT(check("blocked.toml --set sources.0.region='[1, 1, 9, 9]'")["troubles"], IsEmpty());
}

// If the only moment is that of the start there is no step.
TEST_F(Check, NoTimeTakesNoSteps) {
  EXPECT_EQ(check("small.toml --t-end 0")["cost_parts_s"]["steps"], 0.0);
  EXPECT_THAT(carom("check small.toml --t-end 0").out, Not(HasSubstr("years")));
}

TEST_F(LongCheck, EveryFileIsPredictedWithItsSize) {
  const std::string wants =
      "small.toml --t-end 20 --set output.checkpoint=1000 --set output.movie=true --set output.plots='[\"energy\", "
      "\"velocity\"]' --set 'analysis.what=[\"speeds\", \"density\"]'";
  for (const char* const format : {"xyz", "h5md"}) {
    const std::string scene = wants + " --set output.trajectory='\"" + format + "\"'";
    const Json files = check(scene)["files_bytes"];
    EXPECT_FALSE(files.contains("lock")) << "a run removes its lock";
    ASSERT_EQ(carom("run --quiet --force -o out " + scene).status, 0);
    for (const std::string& file : files_in("out")) {
      const bool small = file == "scene.toml" || file == "summary.json" || file == "trajectory.xdmf";
      const bool plot_of_analysis = file == "speeds.svg" || file == "density.svg";
      if (small || plot_of_analysis) continue;
      ASSERT_TRUE(files.contains(file)) << file;
      const double foreseen = files[file], real = static_cast<double>(fs::file_size(at("out") / file));
      EXPECT_LT(foreseen, 3.0 * real + 2e4) << file;
      EXPECT_GT(foreseen, real / 3.0 - 2e4) << file;
    }
  }
}

TEST_F(Check, TheBoxIsThatOfTheScene) {
  const Json j = check("small.toml --set box.height=20.0 --t-end 0.1");
  EXPECT_EQ(j["width"], 10.0);
  EXPECT_EQ(j["height"], 20.0);
  EXPECT_NEAR(j["packing_fraction"].get<double>(), 5.0 * std::numbers::pi * 0.25 / 200.0, 1e-12);
}

// The trial takes a fifth of a second, and 10^8 steps take at least ten.
TEST_F(LongCheck, TheCostIsThatOfTheWholeRun) {
  EXPECT_GT(check("small.toml --t-end 1e6 --set output.every=1e5")["cost_parts_s"]["steps"].get<double>(), 2.0);
}

// The method recommended in the text is that in the JSON: the cheapest of the possible methods.
TEST_F(Check, AnAccuracyHasOneMethod) {
  for (const std::string accuracy : {"1e-1", "1e-3"}) {
    const std::string options = "small.toml --t-end 0.1 --accuracy " + accuracy;
    const Json choice = check(options)["choice"];
    const std::string method = choice["method"];
    EXPECT_THAT(carom("check " + options).out, HasSubstr("use it with --method " + method));
    const Json* best = nullptr;
    for (const Json& offer : choice["offers"]) {
      if (!offer["possible"].get<bool>()) continue;
      if (best == nullptr || offer["cpu_s"] < (*best)["cpu_s"]) best = &offer;
    }
    ASSERT_NE(best, nullptr);
    EXPECT_EQ((*best)["method"], method);
    EXPECT_LE((*best)["error"].get<double>(), std::stod(accuracy));
  }
}

// Disks fly out of the box, so most frames have hardly any.
TEST_F(Check, WhatSinksTakeIsLeftOutOfFiles) {
  std::string sinks;
  for (const char* const side : {"left", "right", "bottom", "top"}) {
    sinks += std::string(" --set box.") + side + "='\"sink\"'";
  }
  const std::string scene = "small.toml --t-end 1000 --set run.dt=0.001 --set disks.0.count=20" + sinks;
  const double foreseen = check(scene)["files_bytes"]["trajectory.xyz"];
  const double full =
      check("small.toml --t-end 1000 --set run.dt=0.001 --set disks.0.count=20")["files_bytes"]["trajectory.xyz"];
  EXPECT_LT(foreseen, 0.6 * full);
  EXPECT_GT(foreseen, 0.05 * full);
}

TEST_F(LongCheck, AMovieIsWhatAShortRunCosts) {
  const Json j = check("small.toml --set output.movie=true");
  EXPECT_GT(j["cost_parts_s"]["frames"].get<double>(), j["cost_parts_s"]["steps"].get<double>());
  EXPECT_GE(j["cost_s"].get<double>(), j["cost_parts_s"]["frames"].get<double>());
  EXPECT_THAT(carom("check small.toml --set output.movie=true").out, HasSubstr(", frames and movie "));
}

TEST_F(LongCheck, ItsRehearsalLeavesNothingBehindAndIsNotNeeded) {
  fs::create_directories(at("temporary"));
  const std::string wants = " check small.toml --set output.movie=true";
  EXPECT_EQ(shell("TMPDIR=$PWD/temporary $C" + wants).status, 0);
  EXPECT_THAT(files_in("temporary"), IsEmpty());
  const Outcome o = shell("TMPDIR=/nonexistent $C" + wants);
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("movie.mp4"));
  EXPECT_THAT(o.out, HasSubstr("(guessed: there is no folder for temporary files)"));
  EXPECT_THAT(files_in(""), Not(::testing::Contains("out")));
}

// If nothing can be written sizes are guessed from the number of disks shown.
TEST_F(Check, AGuessGoesByTheDisksShown) {
  const auto guess = [&](const std::string& select) {
    const Outcome o = shell("TMPDIR=/nonexistent $C check small.toml --t-end 0.1 --json " + select);
    EXPECT_EQ(o.status, 0) << o.err;
    return Json::parse(o.out)["files_bytes"]["trajectory.xyz"].get<double>();
  };
  EXPECT_EQ(guess("--set 'output.select=\"every 5th\"'"), guess("") / 5.0);
}

// Samples are at 0.5, 0.6, ... 1.
TEST_F(Check, SamplesAreCountedFromTheirStart) {
  const Outcome o =
      carom("check small.toml --set 'analysis.what=[\"speeds\"]' --set analysis.every=0.1 --set analysis.start=0.5");
  EXPECT_THAT(o.out, HasSubstr("11 frames, 6 samples: "));
}

// A box of 20 x 10 without disks at the start.
Scene empty_box(const std::string& box, const std::string& more) {
  return parse_scene("[box]\nwidth = 20\nheight = 10\n" + box + more +
                         "[[disks]]\ncount = 0\npositions = \"random\"\nradius = 0.5\nmass = 1\n"
                         "[run]\nmethod = \"pairwise\"\ndt = 0.01\nt_end = 10\n",
                     "empty", "");
}

// Sources fill a box at a constant rate with disks 1 to 19, as the 20th is due at the end: on average half of them are
// there, or a little more. With a limit that is reached after a quarter of the run the mean is 7/8 of it.
TEST(Foresight, ThePopulationRisesEvenly) {
  const std::string source = "[[sources]]\nside = \"top\"\nrate = 2\nradius = 0.5\nmass = 1\n";
  const Population all = foresee_population(empty_box("", source), {});
  EXPECT_DOUBLE_EQ(all.mean, 19.0 * (1.0 - 0.5 * 0.95));
  EXPECT_DOUBLE_EQ(all.end, 19.0);
  const Population limited = foresee_population(empty_box("", source + "limit = 5\n"), {});
  EXPECT_DOUBLE_EQ(limited.mean, 5.0 * 7.0 / 8.0);
  EXPECT_DOUBLE_EQ(limited.end, 5.0);
}

// v^2 = 2 g h from the side through which disks come, with h = 9.5 for their edge.
TEST(Foresight, DisksOfASourceFallFromItsSide) {
  const auto landing = [](const char* gravity, const char* side) {
    const Scene scene = empty_box("", std::string("[physics]\ngravity = ") + gravity + "\n[[sources]]\nside = \"" +
                                          side + "\"\nrate = 2\nradius = 0.5\nmass = 1\n");
    return foresee_steps(scene, {}).landing_speed;
  };
  EXPECT_DOUBLE_EQ(landing("1", "top"), std::sqrt(19.0));
  EXPECT_DOUBLE_EQ(landing("1", "bottom"), 0.0);
  EXPECT_DOUBLE_EQ(landing("[0, 1]", "bottom"), std::sqrt(19.0)) << "upwards";
  EXPECT_DOUBLE_EQ(landing("[0, 1]", "top"), 0.0);
}

// Disks fall furthest from one corner of a source's region, to the contact of a disk of radius 0.5.
TEST(Foresight, DisksOfASourceFallFromTheFarCornerOfItsRegion) {
  const auto way = [](const char* gravity, const char* where) {
    const Scene scene = empty_box("", std::string("[physics]\ngravity = ") + gravity + "\n[[sources]]\n" + where +
                                          "\nrate = 2\nradius = 0.5\nmass = 1\n");
    return 0.5 * std::pow(foresee_steps(scene, {}).landing_speed, 2);
  };
  const char* const region = "region = [2, 3, 8, 6]";
  EXPECT_NEAR(way("1", region), 5.5, 1e-12);
  EXPECT_NEAR(way("[0, 1]", region), 6.5, 1e-12);
  EXPECT_NEAR(way("[1, 0]", region), 17.5, 1e-12);
  EXPECT_NEAR(way("[-1, 0]", region), 7.5, 1e-12);
  EXPECT_NEAR(way("[1, 0]", "side = \"left\""), 19.5, 1e-12);
  EXPECT_NEAR(way("[0, -1]", "side = \"left\""), 9.5, 1e-12) << "from the upper end of the side";
  EXPECT_NEAR(way("[-1, 0]", "side = \"left\""), 0.0, 1e-12);
  EXPECT_NEAR(way("[0, -1]", "side = \"right\""), 9.5, 1e-12);
}

// Each flight is shorter than the one before by the factor of the restitution: together they take e / (1 - e) times a
// flight with the speed of the first landing.
TEST(Foresight, ADiskRestsAfterTheSumOfItsFlights) {
  const auto rest = [](const std::string& velocity, const std::string& gravity, double e) {
    const Scene scene = parse_scene(
        fmt::format("[box]\nwidth = 10\nheight = 10\nwall_restitution = {}\n[physics]\ngravity = {}\n[[disks]]\ncount "
                    "= 1\npositions = [[5, 8.5]]\nvelocities = [{}]\nradius = 0.5\nmass = 1\n[run]\nt_end = 100\n",
                    e, gravity, velocity),
        "fall", "");
    return foresee_collapse(scene, initial_state(scene).disks).from.value_or(0.0);
  };
  EXPECT_NEAR(rest("[0, 0]", "1", 0.5), 4.0 + 8.0, 1e-12);
  EXPECT_NEAR(rest("[0, 0]", "1", 0.25), 4.0 + 8.0 / 3.0, 1e-12);
  EXPECT_NEAR(rest("[7, 3]", "1", 0.5), (3.0 + 5.0) + 10.0, 1e-12) << "first up, and then down from there";
  EXPECT_NEAR(rest("[7, -3]", "1", 0.5), (-3.0 + 5.0) + 10.0, 1e-12);
  EXPECT_NEAR(rest("[0, 0]", "[1, 0]", 0.5), 3.0 + 6.0, 1e-12) << "a fall of 4.5 to the right wall";
  EXPECT_NEAR(rest("[0, 0]", "[0, 2]", 0.5), 1.0 + 2.0, 1e-12) << "a fall of 1 to the ceiling";
}

// The first disk comes at 1 / rate and falls from the edge of the box.
TEST(Foresight, ADiskOfASourceRestsAfterItHasCome) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 10\nwall_restitution = 0.5\n[physics]\ngravity = 1\n[[sources]]\nside = \"top\"\n"
      "rate = 2\nradius = 0.5\nmass = 1\n[run]\nt_end = 100\n",
      "source", "");
  EXPECT_NEAR(foresee_collapse(scene, {}).from.value_or(0.0), 0.5 + std::sqrt(20.0) + 2.0 * std::sqrt(20.0), 1e-12);
}

// Nothing stops a fall along periodic sides.
TEST(Foresight, AFallWithoutAFloorGoesOnToTheEnd) {
  const Scene scene =
      empty_box("bottom = \"periodic\"\ntop = \"periodic\"\n",
                "[physics]\ngravity = 3\n[[sources]]\nside = \"left\"\nrate = 2\nradius = 0.5\nmass = 1\n");
  EXPECT_NEAR(foresee_steps(scene, {}).landing_speed, 30.0, 1e-12);
}

TEST(Foresight, TheFillIsTheAreaOfAllDisks) {
  const std::string source = "[[sources]]\nside = \"top\"\nrate = 2\nradius = 0.5\nmass = 1\n";
  EXPECT_NEAR(foresee_population(empty_box("", source), {}).fill, 19.0 * std::numbers::pi * 0.25 / 200.0, 1e-12);
}

// Sources that would fill the box cause no warning if a sink takes disks.
TEST(Foresight, ASinkMakesRoomForSources) {
  const std::string source = "[[sources]]\nside = \"top\"\nrate = 40\nradius = 0.5\nmass = 1\n";
  const auto troubles = [&](const std::string& box) {
    const Scene scene = empty_box(box, source);
    return foreseen_troubles(scene, foresee_steps(scene, {}), foresee_population(scene, {}), {});
  };
  EXPECT_THAT(troubles(""), ::testing::ElementsAre(HasSubstr("the sources would fill the box")));
  EXPECT_THAT(troubles("bottom = \"sink\"\n"), IsEmpty());
}

}  // namespace
}  // namespace carom
