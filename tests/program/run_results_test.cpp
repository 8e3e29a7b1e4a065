// The output of the real program for a run, and the files that it writes.
#include "io/trajectory/trajectory_xyz.hpp"
#include "tests/support/command_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;
using test::Outcome;
namespace fs = std::filesystem;
using test::replaced;
using test::text_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

using RunResults = test::CommandTest;
using LongRunResults = RunResults;

// A disk that moves by five radii in a step: there is a warning in the summary, or with --strict the run ends, and
// keeps its results so far.
TEST_F(RunResults, StrictEndsARunAtItsFirstWarning) {
  const std::string fast = "run small.toml --set disks.0.velocities='{ uniform = 200.0 }' ";
  const Outcome lenient = carom(fast + "--json -o a");
  EXPECT_EQ(lenient.status, 0) << lenient.err;
  const Json warnings = Json::parse(lenient.out)["warnings"];
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("the step is split into"));
  EXPECT_EQ(Json::parse(text_of(at("a/summary.json")))["warnings"], warnings);
  // The warning during the run is about the first overlap, the one in the summary about the worst.
  const std::string before = "carom: warning: ";
  ASSERT_THAT(lenient.err, StartsWith(before));
  const std::string first = lenient.err.substr(before.size(), lenient.err.find('\n') - before.size());
  EXPECT_THAT(first, HasSubstr("the step is split into"));
  EXPECT_THAT(lenient.err, HasSubstr(before + warnings[0].get<std::string>()));
  expect_error("$C " + fast + "--quiet --strict -o b", 3, first + " (--strict)");
  EXPECT_THAT(text_of(at("b/carom-unfinished/trajectory.xyz")), StartsWith("5\n"));
  const Outcome sound = carom("run small.toml --quiet --strict --json -o c");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_TRUE(Json::parse(sound.out)["warnings"].empty());
}

// The energies of a plot do not depend on the other outputs of a run.
TEST_F(LongRunResults, APlotOfEnergiesNeedsNoSeries) {
  const std::string run =
      "run small.toml --quiet --set output.trajectory=none --set output.movie=false --set output.plots='[\"energy\"]' ";
  ASSERT_EQ(carom(run + "-o with --set output.series=true").status, 0);
  ASSERT_EQ(carom(run + "-o without --set output.series=false").status, 0);
  EXPECT_THAT(text_of(at("with/energy.svg")), HasSubstr("<svg"));
  EXPECT_TRUE(text_of(at("with/energy.svg")) == text_of(at("without/energy.svg")));
}

// A source between disks that never leave it room gives a warning; one with room enough gives none.
TEST_F(RunResults, DisksThatStillWaitAtTheEndAreWarnedOf) {
  const std::string source = "[[sources]]\nregion = [4.9, 4.9, 5.1, 5.1]\nrate = 20\nradius = 0.5\nmass = 1\n";
  write("blocked.toml", replaced(test::small_scene, "[run]", source + "[run]"));
  for (const std::string method : {"rollback", "pairwise", "exact"}) {
    const Outcome o = carom("run blocked.toml --json -o " + method + " --method " + method);
    EXPECT_EQ(o.status, 0) << o.err;
    const Json summary = Json::parse(o.out);
    EXPECT_GT(summary["waiting"], 10);
    ASSERT_EQ(summary["warnings"].size(), 1U) << o.out;
    const auto warning = summary["warnings"][0].get<std::string>();
    EXPECT_THAT(warning, HasSubstr("disks due from sources.0 still wait for room"));
    EXPECT_THAT(o.err, HasSubstr(warning));
  }
  const Outcome room = carom("run blocked.toml --json --quiet -o room --set sources.0.region='[1, 1, 9, 9]'");
  EXPECT_TRUE(Json::parse(room.out)["warnings"].empty()) << room.out;
}

TEST_F(RunResults, JsonIsAllThatIsPrintedAndHasEveryKeyInOrder) {
  const Outcome o = carom("run small.toml -o out --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, IsEmpty()) << "without a terminal there is no progress line";
  const Json summary = Json::parse(o.out);
  std::vector<std::string> keys;
  for (const auto& item : summary.items()) keys.push_back(item.key());
  ASSERT_GE(keys.size(), 24U);
  keys.resize(24);
  EXPECT_THAT(keys, ElementsAre("scene", "method", "engine", "threads", "ranks", "particles", "steps", "time",
                                "collisions", "wall_collisions", "wall_s", "cpu_s", "step_s", "energy_initial",
                                "energy_final", "momentum_drift", "max_overlap", "wall_overlap", "pressure",
                                "collision_rate", "removed", "emitted", "state_hash", "version"));
  EXPECT_EQ(summary["scene"], "small.toml");
  EXPECT_EQ(summary["method"], "pairwise");
  EXPECT_EQ(summary["particles"], 5);
  EXPECT_EQ(summary["steps"], 100);
  EXPECT_EQ(summary["time"], 1.0);
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["frames"], 11);
  EXPECT_LE(summary["step_s"], summary["wall_s"]);
  EXPECT_EQ(summary["state_hash"].get<std::string>().size(), 16U);
  EXPECT_EQ(text_of(at("out/summary.json")), o.out);
}

TEST_F(RunResults, RatesFollowFromTheCounts) {
  const Outcome o = carom("run small.toml --json --quiet -o out --t-end 20 --set disks.0.count=40");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json s = Json::parse(o.out);
  ASSERT_GT(s["collisions"], 100);
  EXPECT_DOUBLE_EQ(s["collision_rate"], 2.0 * s["collisions"].get<double>() / (40.0 * 20.0));
  EXPECT_GT(s["pressure"], s["energy_final"].get<double>() / 100.0) << "more than that of the ideal gas";
  EXPECT_NEAR(s["energy_final"].get<double>() / s["energy_initial"].get<double>(), 1.0, 1e-12);
}

// The mean pressure of a cooling gas does not follow from its energies at the start and the end: none is given.
TEST_F(RunResults, WhatThePressureIsWhereTheEnergyChanges) {
  EXPECT_THAT(carom("run small.toml -o steady").out, testing::ContainsRegex("  pressure    [0-9.e-]+\n"));
  const Outcome o = carom("run small.toml -o cooling --t-end 20 --set box.wall_restitution=0.5");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json s = Json::parse(text_of(at("cooling/summary.json")));
  ASSERT_LT(s["energy_final"], 0.5 * s["energy_initial"].get<double>());
  EXPECT_TRUE(s["pressure"].is_null()) << s["pressure"];
  EXPECT_THAT(o.out, HasSubstr(fmt::format("  pressure    unknown from the kinetic energy of {:.6g} at the start and "
                                           "{:.6g} at the end; series.csv has the pressure over time\n",
                                           s["energy_initial"].get<double>(), s["energy_final"].get<double>())));
  EXPECT_THAT(
      carom("run small.toml -o told --t-end 20 --set box.wall_restitution=0.5 --set output.series=false").out,
      testing::ContainsRegex("  pressure    unknown from [^;]+; output.series = true gives the pressure over time\n"));
  std::string sheared = "run small.toml -o sheared --set box.shear_rate=0.1";
  for (const char* const side : {"left", "right", "bottom", "top"}) {
    sheared += fmt::format(" --set 'box.{}=\"periodic\"'", side);
  }
  EXPECT_THAT(carom(sheared).out, testing::ContainsRegex("  pressure    [0-9.e-]+\n"));
}

// Disks are pressed together in the middle of a run and free again at its end: the summary contains the worst overlap,
// also that of an interrupted run.
TEST_F(RunResults, TheWorstOverlapOfTheRunBesideThatOfItsEnd) {
  const std::string scene = CAROM_SOURCE_DIR "/scenes/stability/mass_ratio_1e6.toml --method pairwise --dt 0.02";
  const Outcome o = carom("run " + scene + " --quiet --json -o out");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json s = Json::parse(o.out);
  EXPECT_EQ(s["max_overlap"], 0.0);
  EXPECT_GT(s["worst_overlap"], 0.1);
  EXPECT_EQ(s["worst_overlap_ids"], Json({0, 1}));
  EXPECT_GT(s["worst_overlap_time"], 15.0);
  EXPECT_LT(s["worst_overlap_time"], 20.0);
  EXPECT_GT(s["worst_wall_overlap"], 0.1);
  EXPECT_EQ(s["worst_wall_overlap_ids"], Json::array({0}));
  ASSERT_EQ(carom("run " + scene + " --quiet -o parts --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume parts --quiet --engine reference").status, 0);
  const Json parts = Json::parse(text_of(at("parts/summary.json")));
  for (const char* const key : {"worst_overlap", "worst_overlap_time", "worst_overlap_ids", "worst_wall_overlap",
                                "worst_wall_overlap_time", "worst_wall_overlap_ids", "warnings"}) {
    EXPECT_EQ(parts[key], s[key]) << key;
  }
}

// A disk that crosses a slot in less than a step: late bounces are too few for a warning during the run, but there is
// one at the end.
TEST_F(RunResults, FewLateBouncesAreToldOfAtTheEnd) {
  write("slot.toml",
        "[box]\nwidth = 1.03\nheight = 20.0\n[[disks]]\ncount = 1\npositions = [[0.51, 10.0]]\n"
        "velocities = [[1.0, 0.01]]\nradius = 0.5\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.05\nt_end = 0.8\n");
  constexpr const char* late = "bounces off walls and obstacles were seen a step late: dt = 0.05 is long";
  const Outcome o = carom("run slot.toml --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr(late));
  const Json warnings = Json::parse(o.out)["warnings"];
  ASSERT_EQ(warnings.size(), 1U) << warnings;
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr(late));
  EXPECT_EQ(Json::parse(carom("run slot.toml --json --dt 0.01").out)["warnings"], Json::array());
}

// u / dt is not a velocity: quantities computed from it are in no file and no plot.
TEST_F(RunResults, BrownianDisksHaveNoEnergy) {
  const std::string scene = "run small.toml --set physics.diffusion=0.1 --set output.plots='[\"energy\"]'";
  const Outcome o = carom(scene + " --json -o out");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("small.toml: output.plots: Brownian disks have no velocities, only a displacement u in "
                               "each step: no energies are plotted\n"));
  const Json s = Json::parse(o.out);
  for (const char* const key : {"energy_initial", "energy_final", "momentum_drift", "pressure"}) {
    EXPECT_TRUE(s[key].is_null()) << key;
  }
  EXPECT_THAT(files_in("out"), ElementsAre("scene.toml", "series.csv", "summary.json", "trajectory.xyz"));
  std::istringstream rows(text_of(at("out/series.csv")));
  std::string row;
  std::getline(rows, row);
  ASSERT_THAT(row, StartsWith("t,disks,kinetic,potential,total,px,py,collisions,wall_collisions,pressure,"));
  while (std::getline(rows, row)) {
    EXPECT_THAT(row.substr(row.find(',')), StartsWith(",5,nan,0,nan,nan,nan,"));
  }
  const Outcome table = carom(scene + " -o table");
  EXPECT_THAT(table.out, Not(HasSubstr("energy")));
  EXPECT_THAT(table.out, Not(HasSubstr("pressure")));
  // With accumulate (F15 of docs/original.md) velocities add up, and then they have an energy.
  EXPECT_TRUE(Json::parse(carom(scene + " --set physics.accumulate=true --quiet --json -o more").out)["energy_final"]
                  .is_number());
}

TEST_F(RunResults, MomentumIsShownWhereItIsKept) {
  EXPECT_THAT(carom("run small.toml -o walls").out, Not(HasSubstr("momentum")));
  std::string periodic;
  for (const char* const side : {"left", "right", "bottom", "top"}) {
    periodic += std::string(" --set box.") + side + "='\"periodic\"'";
  }
  EXPECT_THAT(carom("run small.toml -o periodic" + periodic).out, HasSubstr("momentum    changed by "));
  EXPECT_THAT(carom("run small.toml -o falling --set physics.gravity=0.1" + periodic).out, Not(HasSubstr("momentum")));
}

TEST_F(RunResults, NothingIsNotANumber) {
  const Outcome o = carom("run small.toml --json --quiet -o out --t-end 0 --set disks.0.count=0");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json summary = Json::parse(o.out);
  for (const auto& item : summary.items()) EXPECT_FALSE(item.value().is_null()) << item.key();
  EXPECT_EQ(summary["frames"], 1);
}

TEST_F(RunResults, FramesFromZeroToTheEndNoneTwice) {
  // dt does not divide the interval: frames are made at the ends of steps, the last one at the end of the run.
  ASSERT_EQ(carom("run small.toml --quiet -o out --dt 0.03 --set output.every=0.1").status, 0);
  XyzReader reader(at("out/trajectory.xyz").string());
  XyzFrame frame;
  std::vector<double> times;
  while (reader.read(frame)) times.push_back(frame.time);
  ASSERT_EQ(times.size(), 11U);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_NEAR(times[1], 0.12, 1e-12);
  EXPECT_EQ(times.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end());

  ASSERT_EQ(carom("run small.toml --quiet -o every_step --set output.every=0.001").status, 0);
  EXPECT_EQ(Json::parse(text_of(at("every_step/summary.json")))["frames"], 101);
  ASSERT_EQ(carom("run small.toml --quiet -o ends --set output.every=0.0").status, 0);
  EXPECT_EQ(Json::parse(text_of(at("ends/summary.json")))["frames"], 2);
}

TEST_F(RunResults, FramesOfAnExactRunAreAtTheTimesAskedFor) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --method exact").status, 0);
  XyzReader reader(at("out/trajectory.xyz").string());
  XyzFrame frame;
  int k = 0;
  for (; reader.read(frame); ++k) EXPECT_EQ(frame.time, k < 10 ? k * 0.1 : 1.0);
  EXPECT_EQ(k, 11);
}

TEST_F(RunResults, OutputChangesNothing) {
  const auto hash = [&](const std::string& options) {
    const Outcome o = carom("run small.toml --json " + options);
    EXPECT_EQ(o.status, 0) << o.err;
    return Json::parse(o.out)["state_hash"].get<std::string>();
  };
  const std::string plain = hash("-o a");
  EXPECT_EQ(hash("-o b --quiet --set output.every=0.013"), plain);
  EXPECT_EQ(hash("--set output.trajectory='\"none\"' --set output.series=false"), plain);
  EXPECT_EQ(hash("-o c --threads 2"), plain);
  EXPECT_NE(hash("-o d --seed 2"), plain);
}

TEST_F(RunResults, AnySeedIsReported) {
  const Outcome o = carom("run small.toml --json --quiet -o out --seed 18446744073709551615");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(Json::parse(o.out)["seed"], 18446744073709551615ULL);
  EXPECT_EQ(carom("run out/scene.toml --quiet -o again").status, 0);
  EXPECT_EQ(carom("compare out again").status, 0) << "the resolved scene gives the same run";
}

TEST_F(RunResults, WhereResultsGo) {
  Outcome o = carom("run small.toml");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.err, HasSubstr("results go to out/small"));
  EXPECT_THAT(o.out, HasSubstr("state hash"));
  EXPECT_THAT(files_in("out/small"), ElementsAre("scene.toml", "series.csv", "summary.json", "trajectory.xyz"));
  expect_error("$C run small.toml -o out/small", 2, "out/small: holds scene.toml of an earlier run");
  const std::string before = text_of(at("out/small/summary.json"));
  o = carom("run small.toml");
  EXPECT_EQ(o.status, 0) << "the second time, too";
  EXPECT_THAT(o.err, HasSubstr("results go to out/small-2 (out/small holds another run; --force replaces it)\n"));
  EXPECT_THAT(files_in("out/small-2"), ElementsAre("scene.toml", "series.csv", "summary.json", "trajectory.xyz"));
  EXPECT_THAT(carom("run small.toml --max-walltime 1e-9 --t-end 1e6").err, HasSubstr("results go to out/small-3"));
  fs::remove_all(at("out/small"));
  ASSERT_EQ(carom("run small.toml --max-walltime 1e-9 --t-end 1e6").status, 4);
  EXPECT_THAT(
      carom("run small.toml").err,
      HasSubstr(
          "results go to out/small-4 (out/small holds another run; carom resume out/small continues that run)\n"));
  EXPECT_EQ(carom("resume out/small --quiet --t-end 1").status, 0);
  EXPECT_EQ(text_of(at("out/small/trajectory.xyz")), text_of(at("out/small-2/trajectory.xyz")));
  o = carom("run small.toml --force --quiet --seed 7");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.out + o.err, IsEmpty());
  EXPECT_NE(text_of(at("out/small/summary.json")), before);
  o = carom("run small.toml --set output.trajectory='\"none\"' --set output.series=false");
  EXPECT_EQ(o.status, 0) << "a scene without files needs no folder";
  EXPECT_THAT(o.err, IsEmpty());
}

TEST_F(LongRunResults, AFullDiskLeavesNothing) {
  // The limit on the size of a file, in blocks of 512 bytes, acts like a full disk on each file that reaches it.
  const std::string run = "ulimit -f 8; $C run small.toml --quiet -o full/out ";
  expect_error(run + "--set output.every=0.01", 1, "trajectory.xyz: File too large");
  const std::string no_files = "--set output.series=false --set output.trajectory='\"none\"' ";
  EXPECT_THAT(files_in(""), ElementsAre("small.toml"));
  // If pictures fail, nothing else is lost.
  expect_error(run + no_files + "--set output.movie=true", 1, "movie.mp4: ");
  EXPECT_THAT(files_in("full/out"), ElementsAre("scene.toml", "summary.json"));
  expect_error(run + no_files + "--force --set output.plots='[\"energy\"]'", 1, "energy.svg: ");
  EXPECT_THAT(files_in("full/out"), ::testing::IsSupersetOf({"scene.toml", "summary.json"}));
  expect_error("$C run small.toml --json --quiet -o out >/dev/full", 1, "standard output: No space left on device");
}

TEST_F(RunResults, ClosedStreamsNeverEndUpInAFile) {
  EXPECT_EQ(shell("$C run small.toml --dt 0.3 --t-end 3 -o out 2>&-").status, 0);
  XyzReader reader(at("out/trajectory.xyz").string());
  XyzFrame frame;
  int frames = 0;
  while (reader.read(frame)) ++frames;
  EXPECT_GT(frames, 5);
  EXPECT_EQ(shell("$C run small.toml --quiet --json -o other >&-").status, 1);
}

TEST_F(RunResults, WhatThePhysicsStopsIsKeptButNoResult) {
  expect_error("$C run small.toml --quiet -o out --dt 0.5 --set disks.0.velocities.uniform=1e4", 3,
               "are kept in out/carom-unfinished");
  EXPECT_THAT(files_in("out"), ElementsAre("carom-unfinished"));
  expect_error("$C run small.toml --quiet -o out", 2, "another run is writing there, or stopped before its end");
  EXPECT_EQ(carom("run small.toml --quiet -o out --force").status, 0);
  EXPECT_THAT(files_in("out"), Not(::testing::Contains("carom-unfinished")));
}

TEST_F(RunResults, WithoutGnuplotAndFfmpegTheRunSucceeds) {
  const Outcome o = shell(
      "PATH=/nonexistent $C run small.toml --json -o out --set output.every=0.5 --set output.movie=true "
      "--set output.plots='[\"velocity\", \"energy\"]'");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err,
            "carom: warning: ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on\n"
            "carom: warning: gnuplot is not installed: no plots are drawn\n");
  EXPECT_EQ(files_in("out/frames").size(), 3U);
}

TEST_F(RunResults, PlotsNeedNoFolderForTemporaryFiles) {
  const Outcome o = shell("TMPDIR=/nonexistent $C run small.toml --quiet -o out --set output.plots='[\"energy\"]'");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(files_in("out"), ElementsAre("energy.svg", "scene.toml", "series.csv", "summary.json", "trajectory.xyz"));
}

// If gnuplot fails to draw plots, only these are lost; they are drawn when the run is resumed.
TEST_F(LongRunResults, APlotThatFailsCostsNothingElse) {
  fs::create_directories(at("bin"));
  write("bin/gnuplot", "#!/bin/sh\necho no fonts >&2\nexit 1\n");
  fs::permissions(at("bin/gnuplot"), fs::perms::owner_all);
  const std::string plots = " --set output.plots='[\"velocity\", \"energy\"]' --set output.movie=true";
  ASSERT_EQ(carom("run small.toml --quiet -o whole" + plots).status, 0);
  const std::string fails = "PATH=\"$PWD/bin:$PATH\" $C ";
  expect_error(
      fails + "run small.toml --quiet -o out" + plots, 1,
      "gnuplot could not draw out/carom-unfinished/velocity.svg: no fonts; gnuplot could not draw "
      "out/carom-unfinished/energy.svg: no fonts; all other results are in out; carom resume out draws the plots\n");
  EXPECT_THAT(files_in("out"), ElementsAre("checkpoint.carom", "movie.mp4", "scene.toml", "series.csv", "summary.json",
                                           "trajectory.xyz"));
  expect_error(fails + "resume out --quiet", 1, "no fonts");
  EXPECT_EQ(carom("resume out --quiet").status, 0);
  expect_same_results("whole", "out");
  EXPECT_FALSE(fs::exists(at("out/checkpoint.carom")));
}

TEST_F(LongRunResults, AMovieThatFailsCostsNothingElse) {
  fs::create_directories(at("bin"));
  write("bin/ffmpeg", "#!/bin/sh\nhead -c 1000 >/dev/null\necho broken >&2\nexit 1\n");
  fs::permissions(at("bin/ffmpeg"), fs::perms::owner_all);
  ASSERT_EQ(carom("run small.toml --quiet -o whole").status, 0);
  expect_error("PATH=\"$PWD/bin:$PATH\" $C run small.toml --quiet -o out --set output.movie=true", 1,
               "movie.mp4: broken; all other results are in out; carom render out makes the movie\n");
  EXPECT_EQ(text_of(at("out/trajectory.xyz")), text_of(at("whole/trajectory.xyz")));
  EXPECT_EQ(Json::parse(text_of(at("out/summary.json")))["state_hash"],
            Json::parse(text_of(at("whole/summary.json")))["state_hash"]);
  EXPECT_EQ(carom("render out --quiet").status, 0);
}

TEST_F(RunResults, AFolderThatCannotBeIsRefusedBeforeAnythingIsDone) {
  expect_error("$C run small.toml -o /", 2, "/: is the root of all folders; expected a folder for this run, such as");
  expect_error("$C run small.toml -o / --force", 2, "-o out/small");
  expect_error("$C run small.toml -o /proc/nothing/out", 2, "/proc/nothing/out: cannot be made: ");
  expect_error("$C run small.toml -o small.toml/out", 2, "small.toml/out: cannot be made: Not a directory");
  EXPECT_THAT(files_in(""), ElementsAre("small.toml"));
}

TEST_F(RunResults, AllOutputsAtOnce) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --set output.every=0.5 --set output.movie=true "
                  "--set output.plots='[\"velocity\", \"energy\"]'")
                .status,
            0);
  EXPECT_THAT(files_in("out"), ElementsAre("energy.svg", "movie.mp4", "scene.toml", "series.csv", "summary.json",
                                           "trajectory.xyz", "velocity.svg"));
}

}  // namespace
}  // namespace carom
