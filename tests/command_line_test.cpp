// The real program, as a user or another program calls it: exit statuses, one-line errors, what it prints and leaves.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "io/trajectory_xyz.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* small_scene = R"(title = "small"
[box]
width = 10.0
height = 10.0
[[disks]]
count = 5
positions = "random"
velocities = { uniform = 1.0 }
radius = 0.5
mass = 1.0
[run]
method = "pairwise"
dt = 0.01
t_end = 1.0
[output]
every = 0.1
trajectory = "xyz"
series = true
)";

struct Outcome {
  int status = -1;
  std::string out, err;
};

class CommandLine : public ::testing::Test {
 protected:
  CommandLine() {
    const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("carom_command_line_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "work");
    write("small.toml", small_scene);
  }
  ~CommandLine() override { fs::remove_all(folder_); }

  fs::path at(const std::string& name) const { return folder_ / "work" / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(at(name)) << text; }
  static std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  // Runs a line of shell in the test's folder, in which $C is the program.
  Outcome shell(const std::string& line) const {
    const std::string command = "cd '" + at("").string() + "' && C='" CAROM_PROGRAM "' && { " + line + "; } >'" +
                                (folder_ / "out").string() + "' 2>'" + (folder_ / "err").string() + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "out"), read(folder_ / "err")};
  }
  Outcome carom(const std::string& arguments) const { return shell("$C " + arguments); }

  // One line on standard error that says what is wrong, nothing on standard output.
  void expect_error(const std::string& line, int status, const std::string& what) const {
    const Outcome o = shell(line);
    EXPECT_EQ(o.status, status) << line << "\n" << o.err;
    EXPECT_THAT(o.out, IsEmpty()) << line;
    EXPECT_THAT(o.err, StartsWith("carom: error: ")) << line;
    EXPECT_THAT(o.err, HasSubstr(what)) << line;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << line << "\n" << o.err;
  }

  std::vector<std::string> files_in(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(at(name))) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder_;
};

// A disk that moves five radii a step: a warning in the summary, or the end with --strict, with what there was till
// then.
TEST_F(CommandLine, StrictEndsARunAtItsFirstWarning) {
  const std::string fast = "run small.toml --set disks.0.velocities='{ uniform = 200.0 }' ";
  const Outcome lenient = carom(fast + "--quiet --json -o a");
  EXPECT_EQ(lenient.status, 0) << lenient.err;
  const Json warnings = Json::parse(lenient.out)["warnings"];
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("the step is split into"));
  EXPECT_EQ(Json::parse(read(at("a/summary.json")))["warnings"], warnings);
  expect_error("$C " + fast + "--quiet --strict -o b", 3, warnings[0].get<std::string>() + " (--strict)");
  EXPECT_THAT(read(at("b/carom-unfinished/trajectory.xyz")), StartsWith("5\n"));
  const Outcome sound = carom("run small.toml --quiet --strict --json -o c");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_TRUE(Json::parse(sound.out)["warnings"].empty());
}

TEST_F(CommandLine, BadUsageIsOneLineWithStatusTwo) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no command given; expected one of run, check, resume, compare, render, sweep, chart"},
      {"rnu small.toml",
       "there is no command \"rnu\"; expected one of run, check, resume, compare, render, sweep, chart (nearest: run)"},
      {"--jsn", "no option \"--jsn\" before the command"},
      {"run", "run: no scene file given"},
      {"run --methd pairwise small.toml", "run: there is no option \"--methd\""},
      {"run --methd pairwise small.toml", "(nearest: --method)"},
      {"run small.toml other.toml", "one argument too many, \"other.toml\""},
      {"run small.toml --dt", "--dt: its value is missing"},
      {"run small.toml --dt abc", "--dt: \"abc\" is not a number"},
      {"run small.toml --dt 0.1x", "--dt: \"0.1x\" is not a number"},
      {"run small.toml --dt nan", "--dt: \"nan\" is not a number"},
      {"run small.toml --dt -1", "--dt: is -1; expected a number above 0"},
      {"run small.toml --t-end -1", "--t-end: is -1"},
      {"run small.toml --seed -3", "--seed: is \"-3\""},
      {"run small.toml --seed 18446744073709551616", "--seed: is \"18446744073709551616\""},
      {"run small.toml --method pairwize", "--method: there is no method \"pairwize\""},
      {"run small.toml --method pairwize", "(nearest: pairwise)"},
      {"run small.toml --engine fast", "--engine: there is no engine \"fast\""},
      {"run small.toml --threads 0", "--threads: is \"0\"; expected a whole number of 1 or more"},
      {"run small.toml --threads two", "--threads: is \"two\""},
      {"run small.toml --set dt", "--set: is \"dt\"; expected KEY=VALUE"},
      {"run small.toml --set run.dtt=1", "--set run.dtt: unknown key"},
      {"run small.toml --set run.dt=-1", "--set run.dt: is -1"},
      {"run small.toml -o --json", "-o: \"--json\" is an option"},
      {"run small.toml -o small.toml", "small.toml: is a file; expected a folder"},
      {"run small.toml -o small.toml/out", "cannot be made: Not a directory"},
      {"run small.toml -o /dev/full", "/dev/full: is a file"},
      {"run missing.toml", "missing.toml: "},
      {"run small.toml --max-walltime soon",
       "--max-walltime: is \"soon\"; expected a time such as 30 s, 10 min or 2 h"},
      {"run small.toml --set output.checkpoint=0", "--set output.checkpoint: is 0; expected a number above 0"},
      {"run small.toml --set output.checkpoint='\"2 days\"'",
       "--set output.checkpoint: is \"2 days\"; expected a time"},
      {"resume", "resume: no checkpoint given"},
      {"resume missing", "missing: does not exist; expected a checkpoint"},
      {"resume .", ".: holds no checkpoint"},
      {"resume small.toml", "small.toml: is no checkpoint of Carom"},
      {"resume small.toml --dt 1", "resume: there is no option \"--dt\""},
      {"check", "check: no scene file given"},
      {"check small.toml --json --dt x", "--dt: \"x\" is not a number"},
      {"compare small.toml", "compare: two outputs are needed"},
      {"compare missing small.toml", "missing: does not exist"},
      {"render", "render: no folder given"},
      {"render .", ".: holds no trajectory.xyz"},
      {"render small.toml", "small.toml:1: "},
      {"render small.toml --frame 0", "--frame: is \"0\""},
  };
  for (const auto& [arguments, what] : cases) expect_error("$C " + arguments, 2, what);
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "nothing is left behind";
}

TEST_F(CommandLine, HelpAndVersion) {
  EXPECT_EQ(carom("--version").out.substr(0, 6), "carom ");
  for (const char* const command : {"", "run", "check", "resume", "compare", "render"}) {
    const Outcome o = carom(std::string(command) + " --help");
    EXPECT_EQ(o.status, 0);
    EXPECT_THAT(o.out, HasSubstr("Usage: carom")) << command;
    EXPECT_THAT(o.err, IsEmpty());
  }
}

TEST_F(CommandLine, JsonIsAllThatIsPrintedAndHasEveryKeyInOrder) {
  const Outcome o = carom("run small.toml -o out --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, IsEmpty()) << "no progress line where there is no terminal";
  const Json summary = Json::parse(o.out);
  std::vector<std::string> keys;
  for (const auto& item : summary.items()) keys.push_back(item.key());
  ASSERT_GE(keys.size(), 23U);
  keys.resize(23);
  EXPECT_THAT(keys, ElementsAre("scene", "method", "engine", "threads", "particles", "steps", "time", "collisions",
                                "wall_collisions", "wall_s", "cpu_s", "step_s", "energy_initial", "energy_final",
                                "momentum_drift", "max_overlap", "wall_overlap", "pressure", "collision_rate",
                                "removed", "emitted", "state_hash", "version"));
  EXPECT_EQ(summary["scene"], "small.toml");
  EXPECT_EQ(summary["method"], "pairwise");
  EXPECT_EQ(summary["particles"], 5);
  EXPECT_EQ(summary["steps"], 100);
  EXPECT_EQ(summary["time"], 1.0);
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_EQ(summary["frames"], 11);
  EXPECT_LE(summary["step_s"], summary["wall_s"]);
  EXPECT_EQ(summary["state_hash"].get<std::string>().size(), 16U);
  EXPECT_EQ(read(at("out/summary.json")), o.out);
}

TEST_F(CommandLine, RatesFollowFromTheCounts) {
  const Outcome o = carom("run small.toml --json --quiet -o out --t-end 20 --set disks.0.count=40");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json s = Json::parse(o.out);
  ASSERT_GT(s["collisions"], 100);
  EXPECT_DOUBLE_EQ(s["collision_rate"], 2.0 * s["collisions"].get<double>() / (40.0 * 20.0));
  EXPECT_GT(s["pressure"], s["energy_final"].get<double>() / 100.0) << "more than the ideal gas";
  EXPECT_NEAR(s["energy_final"].get<double>() / s["energy_initial"].get<double>(), 1.0, 1e-12);
}

TEST_F(CommandLine, NothingIsNotANumber) {
  const Outcome o = carom("run small.toml --json --quiet -o out --t-end 0 --set disks.0.count=0");
  ASSERT_EQ(o.status, 0) << o.err;
  const Json summary = Json::parse(o.out);
  for (const auto& item : summary.items()) EXPECT_FALSE(item.value().is_null()) << item.key();
  EXPECT_EQ(summary["frames"], 1);
}

TEST_F(CommandLine, FramesFromZeroToTheEndNoneTwice) {
  // dt does not divide the interval; frames come at the ends of steps, the last one at the end of the run.
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
  EXPECT_EQ(Json::parse(read(at("every_step/summary.json")))["frames"], 101);
  ASSERT_EQ(carom("run small.toml --quiet -o ends --set output.every=0.0").status, 0);
  EXPECT_EQ(Json::parse(read(at("ends/summary.json")))["frames"], 2);
}

TEST_F(CommandLine, FramesOfAnExactRunAreAtTheTimesAskedFor) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --method exact").status, 0);
  XyzReader reader(at("out/trajectory.xyz").string());
  XyzFrame frame;
  int k = 0;
  for (; reader.read(frame); ++k) EXPECT_EQ(frame.time, k < 10 ? k * 0.1 : 1.0);
  EXPECT_EQ(k, 11);
}

TEST_F(CommandLine, LookingChangesNothing) {
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

TEST_F(CommandLine, AnySeedIsReported) {
  const Outcome o = carom("run small.toml --json --quiet -o out --seed 18446744073709551615");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(Json::parse(o.out)["seed"], 18446744073709551615ULL);
  EXPECT_EQ(carom("run out/scene.toml --quiet -o again").status, 0);
  EXPECT_EQ(carom("compare out again").status, 0) << "the resolved scene gives the same run";
}

TEST_F(CommandLine, WhereResultsGo) {
  Outcome o = carom("run small.toml");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.err, HasSubstr("results go to out/small"));
  EXPECT_THAT(o.out, HasSubstr("state hash"));
  EXPECT_THAT(files_in("out/small"), ElementsAre("scene.toml", "series.csv", "summary.json", "trajectory.xyz"));
  expect_error("$C run small.toml", 2, "out/small: holds scene.toml of an earlier run");
  const std::string before = read(at("out/small/summary.json"));
  o = carom("run small.toml --force --quiet --seed 7");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.out + o.err, IsEmpty());
  EXPECT_NE(read(at("out/small/summary.json")), before);
  o = carom("run small.toml --set output.trajectory='\"none\"' --set output.series=false");
  EXPECT_EQ(o.status, 0) << "a scene that asks for no file has no folder";
  EXPECT_THAT(o.err, IsEmpty());
}

TEST_F(CommandLine, AFullDiskLeavesNothing) {
  // The limit on the size of a file, in blocks of 512 bytes, acts like a full disk on each file that reaches it.
  const std::string run = "ulimit -f 8; $C run small.toml --quiet -o full/out ";
  expect_error(run + "--set output.every=0.01", 1, "trajectory.xyz: File too large");
  const std::string no_files = "--set output.series=false --set output.trajectory='\"none\"' ";
  expect_error(run + no_files + "--set output.movie=true", 1, "movie.mp4: ");
  expect_error(run + no_files + "--set output.plots='[\"energy\"]'", 1, "energy.svg: ");
  EXPECT_THAT(files_in(""), ElementsAre("small.toml"));
  expect_error("$C run small.toml --json --quiet -o out >/dev/full", 1, "standard output: No space left on device");
}

TEST_F(CommandLine, ClosedStreamsNeverEndUpInAFile) {
  EXPECT_EQ(shell("$C run small.toml --dt 0.3 --t-end 3 -o out 2>&-").status, 0);
  XyzReader reader(at("out/trajectory.xyz").string());
  XyzFrame frame;
  int frames = 0;
  while (reader.read(frame)) ++frames;
  EXPECT_GT(frames, 5);
  EXPECT_EQ(shell("$C run small.toml --quiet --json -o other >&-").status, 1);
}

TEST_F(CommandLine, WhatThePhysicsStopsIsKeptButNoResult) {
  expect_error("$C run small.toml --quiet -o out --dt 0.5 --set disks.0.velocities.uniform=1e4", 3,
               "is kept in out/carom-unfinished");
  EXPECT_THAT(files_in("out"), ElementsAre("carom-unfinished"));
  expect_error("$C run small.toml --quiet -o out", 2, "another run is writing there, or stopped before its end");
  EXPECT_EQ(carom("run small.toml --quiet -o out --force").status, 0);
  EXPECT_THAT(files_in("out"), Not(::testing::Contains("carom-unfinished")));
}

TEST_F(CommandLine, WithoutGnuplotAndFfmpegTheRunSucceeds) {
  const Outcome o = shell(
      "PATH=/nonexistent $C run small.toml --json -o out --set output.every=0.5 --set output.movie=true "
      "--set output.plots='[\"velocity\", \"energy\"]'");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err,
            "carom: warning: ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on\n"
            "carom: warning: gnuplot is not installed: no plots are drawn\n");
  EXPECT_EQ(files_in("out/frames").size(), 3U);
}

TEST_F(CommandLine, AllOutputsAtOnce) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --set output.every=0.5 --set output.movie=true "
                  "--set output.plots='[\"velocity\", \"energy\"]'")
                .status,
            0);
  EXPECT_THAT(files_in("out"), ElementsAre("energy.svg", "movie.mp4", "scene.toml", "series.csv", "summary.json",
                                           "trajectory.xyz", "velocity.svg"));
}

TEST_F(CommandLine, ChartWritesAllItsFilesOrNone) {
  ASSERT_EQ(carom("chart --tiny --quiet -o chart").status, 0);
  const std::vector<std::string> names = files_in("chart");
  EXPECT_THAT(names,
              ElementsAre("chart.csv", "chart.json", "chart.png", "chart.svg", "chart_all.png", "chart_all.svg"));
  EXPECT_EQ(Json::parse(read(at("chart/chart.json")))["scenes"].size(), 7U);
  expect_error("$C chart --tiny --quiet -o chart", 2, "chart/chart.svg: exists already");
  expect_error("$C chart --tiny -o small.toml", 2, "small.toml: is a file");
  expect_error("$C chart --quik", 2, "chart: there is no option \"--quik\"; expected one of");
  expect_error("$C chart now", 2, "chart: one argument too many, \"now\"");
  // Ctrl-C long before the end.
  shell("timeout --signal=INT 1 $C chart --quiet -o stopped/here");
  EXPECT_THAT(files_in(""), ElementsAre("chart", "small.toml"));
}

TEST_F(CommandLine, CheckSaysWhatAnAccuracyNeeds) {
  const Outcome plain = carom("check small.toml");
  EXPECT_THAT(plain.out, HasSubstr("--accuracy 1e-3 says"));
  const Outcome o = carom("check small.toml --accuracy 1e-4");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.out, HasSubstr("for an error of 0.0001 in averages"));
  EXPECT_THAT(o.out, HasSubstr("take it with --method "));
  EXPECT_THAT(o.out, Not(HasSubstr("--accuracy 1e-3 says")));
  const Json j = Json::parse(carom("check small.toml --accuracy 1e-4 --json").out);
  EXPECT_EQ(j["choice"]["offers"].size(), 2U);
  EXPECT_EQ(j["choice"]["method"], "exact");
  expect_error("$C check small.toml --accuracy x", 2, "--accuracy: \"x\" is not a number");
  expect_error("$C check small.toml --accuracy 0", 2, "--accuracy: is 0; expected a relative error above 0");
  expect_error("$C check small.toml --accuracy 0.5", 2, "--accuracy: is 0.5; expected a relative error");
}

TEST_F(CommandLine, MethodAutoIsReportedAndKept) {
  const Outcome o = carom("run small.toml -o out --method auto --set run.accuracy=1e-4 --json");
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, StartsWith("carom: method auto, accuracy 0.0001: exact ("));
  EXPECT_EQ(Json::parse(o.out)["method"], "exact");
  EXPECT_THAT(read(at("out/scene.toml")), HasSubstr("# chosen by method = \"auto\", accuracy = 0.0001: "));
  const Outcome again = carom("run out/scene.toml -o again --json");
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_EQ(Json::parse(again.out)["state_hash"], Json::parse(o.out)["state_hash"]);
  expect_error("$C run small.toml --method auto", 2, "run.accuracy: missing; expected the relative error");
  expect_error("$C run small.toml --method aut", 2, "(nearest: auto)");
  EXPECT_THAT(carom("check small.toml --set run.accuracy=1e-3").err, HasSubstr("only method \"auto\" uses it"));
}

TEST_F(CommandLine, CompareFindsTheFirstBit) {
  ASSERT_EQ(carom("run small.toml --quiet -o a").status, 0);
  ASSERT_EQ(carom("run small.toml --quiet -o b").status, 0);
  Outcome o = carom("compare a b");
  EXPECT_EQ(o.status, 0) << o.out;
  EXPECT_EQ(o.out, "same bits in all 11 frames\n");

  // One digit more in the y of disk 3, in the fourth frame only.
  std::string text = read(at("b/trajectory.xyz"));
  std::istringstream lines(text);
  std::string changed, line;
  for (int n = 1; std::getline(lines, line); ++n) {
    if (n == 3 * 7 + 2 + 4) line.insert(line.find(' ', 2) + 1, 1, '1');
    changed += line + '\n';
  }
  write("changed.xyz", changed);
  o = carom("compare a/trajectory.xyz changed.xyz");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("different: first in frame 4 (t = 0.3"));
  EXPECT_THAT(o.out, HasSubstr("disk 3, y: "));
  const Json j = Json::parse(carom("compare a/trajectory.xyz changed.xyz --json").out);
  EXPECT_EQ(j["same"], false);
  EXPECT_EQ(j["first"]["quantity"], "y");
  EXPECT_EQ(j["largest"].size(), 1U);

  ASSERT_EQ(carom("run small.toml --quiet -o longer --t-end 1.5").status, 0);
  o = carom("compare a longer");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.out, HasSubstr("11 frames against 16"));
  EXPECT_THAT(o.out, HasSubstr("steps           100 against 150"));
}

TEST_F(CommandLine, RenderMakesAPictureAndAMovie) {
  ASSERT_EQ(carom("run small.toml --quiet -o out --set output.every=0.5").status, 0);
  EXPECT_EQ(carom("render out --frame 2").out, "out/frame_2.png\n");
  EXPECT_THAT(read(at("out/frame_2.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(carom("render out").out, "out/movie.mp4\n");
  expect_error("$C render out", 2, "out/movie.mp4: exists already");
  expect_error("$C render out --frame 4", 2, "there is no frame 4; expected 1 to 3");
  EXPECT_EQ(carom("render out/trajectory.xyz -o elsewhere.png --frame 1 --quiet").status, 0);
  EXPECT_THAT(files_in(""), ElementsAre("elsewhere.png", "out", "small.toml"));
}

TEST_F(CommandLine, CheckSaysWhatItWouldModel) {
  Outcome o = carom("check small.toml --set physics.gravity=0.5");
  EXPECT_EQ(o.status, 0) << o.err;
  for (const char* const part :
       {"5, radius 0.5, mass 1", "10 x 10, packing fraction 0.03927", "left wall", "gravity 0.5",
        "pairwise, dt = 0.01, 100 steps", "dt is safe", "11 frames", "memory", "cost"}) {
    EXPECT_THAT(o.out, HasSubstr(part));
  }
  EXPECT_THAT(files_in(""), ElementsAre("small.toml")) << "check writes nothing";
  o = carom("check small.toml --json");
  EXPECT_EQ(Json::parse(o.out)["particles"], 5);
}

// A scene that the machine could hold and this process may not: a fault of the scene, whether it is run or checked. The
// address sanitizer takes more room for itself than the limit leaves.
TEST_F(CommandLine, DisksThatFindNoMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer needs terabytes of address space";
#endif
  for (const char* const command : {"run --quiet", "check"}) {
    expect_error(std::string("ulimit -v 600000; $C ") + command +
                     " small.toml --set disks.0.count=20000000 --set disks.0.radius=1e-5",
                 2, "small.toml: disks: 20000000 disks do not fit into the memory that this process may use");
  }
  EXPECT_THAT(files_in(""), ElementsAre("small.toml"));
}

TEST_F(CommandLine, CollapseWithoutTheExactMethodIsWarnedOf) {
  const std::string collapse = " --set 'physics.collapse={ model = \"tc\", contact_time = 1e-3 }'";
  for (const std::string command : {"run small.toml -o out --json", "check small.toml"}) {
    const Outcome o = carom(command + collapse);
    EXPECT_EQ(o.status, 0);
    EXPECT_EQ(o.err,
              "carom: warning: small.toml: physics.collapse: only the exact method uses it, method pairwise does "
              "not\n");
  }
  EXPECT_THAT(carom("check small.toml --method exact" + collapse).err, IsEmpty());
}

TEST_F(CommandLine, ProgressOnATerminalOnly) {
  // script(1) gives the program a terminal. Pictures, as there is no ffmpeg, make the run long enough for a line.
  const Outcome o =
      shell("script -qec \"PATH=/nonexistent $C run small.toml -o out --set output.movie=true\" /dev/null");
  EXPECT_EQ(o.status, 0) << o.out;
  EXPECT_THAT(o.out, HasSubstr(" of 1  "));
  EXPECT_THAT(o.out, HasSubstr(" steps/s  "));
  EXPECT_THAT(o.out, HasSubstr(" left"));
}

}  // namespace
}  // namespace carom
