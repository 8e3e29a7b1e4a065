// Signals, limits and faults: the messages and exit statuses of the program; and carom resume, which loses nothing.
#include <csignal>

#include "io/checkpoint/checkpoint.hpp"
#include "tests/support/program_support.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::text_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class InterruptedRun : public test::ProgramTest {
 protected:
  InterruptedRun() { write("busy.toml", test::busy_scene("pairwise", "plots = [\"velocity\", \"energy\"]\n")); }

  // Waits for a file; a run that never writes it fails the test by the test's time limit.
  static void await(const fs::path& file) {
    while (!fs::exists(file)) usleep(1000);
  }
};
using LongInterruptedRun = InterruptedRun;

TEST_F(LongInterruptedRun, StoppedAgainAndAgainItGivesTheSameResults) {
  for (const std::string method : {"pairwise", "exact"}) {
    ASSERT_EQ(carom("run busy.toml --quiet -o whole --force --t-end 8 --method " + method).status, 0);
    const Resumed resumed = resume_to_the_end(
        "parts", carom("run busy.toml --quiet -o parts --force --max-walltime 1e-9 --t-end 8 --method " + method));
    EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
    EXPECT_GE(resumed.parts, 3);
    EXPECT_THAT(resumed.said, HasSubstr("stopped by --max-walltime at t = "));
    EXPECT_THAT(resumed.said, HasSubstr(" of 8; resume it with carom resume parts\n"));
    expect_same_results("whole", "parts");
    EXPECT_FALSE(fs::exists(at("parts/checkpoint.carom"))) << "the scene asks for no checkpoints";
  }
}

// Without series.csv, too, means over the time since the last frame are continued.
TEST_F(LongInterruptedRun, ObservablesOfATrajectoryGoOn) {
  const std::string run =
      "run busy.toml --quiet --t-end 4 --set output.trajectory=h5md --set output.series=false --set "
      "output.movie=false ";
  ASSERT_EQ(carom(run + "-o whole").status, 0);
  const Resumed resumed = resume_to_the_end("parts", carom(run + "-o parts --max-walltime 1e-9"));
  EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
  EXPECT_GE(resumed.parts, 3);
  const Outcome o = shell(
      "/usr/bin/python3 -c 'import h5py, numpy\n"
      "a, b = (h5py.File(f + \"/trajectory.h5\")[\"observables\"] for f in (\"whole\", \"parts\"))\n"
      "print([k for k in a if not numpy.array_equal(a[k][\"value\"][:], b[k][\"value\"][:], equal_nan=True)],"
      " len(a[\"pressure/value\"]) > 10)'");
  EXPECT_EQ(o.out, "[] True\n") << o.err;
}

// The counts behind a warning are continued: it comes once, in the part in which the undisturbed run has it.
TEST_F(LongInterruptedRun, ItWarnsOfTheSame) {
  const std::string scene = CAROM_SOURCE_DIR "/scenes/stability/f02_bounce_at_a_distance.toml";
  const std::string dense = " --set disks.0.count=300 --set box.packing_fraction=0.5 --method pairwise --dt 0.05";
  const std::string warning = "collisions were seen a step late";
  ASSERT_EQ(carom("run " + scene + dense + " --t-end 40 --quiet -o whole").status, 0);
  ASSERT_THAT(text_of(at("whole/summary.json")), HasSubstr(warning));
  const Resumed resumed =
      resume_to_the_end("parts", carom("run " + scene + dense + " --t-end 40 -o parts --max-walltime 1e-9"), "");
  EXPECT_EQ(resumed.last.status, 0) << resumed.last.err;
  EXPECT_GE(resumed.parts, 3);
  expect_same_results("whole", "parts");
  const std::size_t first = resumed.said.find(warning);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(resumed.said.find(warning, first + 1), std::string::npos) << resumed.said;
}

// A strict run stops at its first warning. Resumed with --strict it stops again; without it the run goes on, and its
// summary contains the warning.
TEST_F(InterruptedRun, AWarningThatEndedARunIsNotForgotten) {
  const std::string scene = CAROM_SOURCE_DIR "/scenes/stability/f02_bounce_at_a_distance.toml";
  const std::string dense = " --set disks.0.count=300 --set box.packing_fraction=0.5 --method pairwise --dt 0.05";
  const Outcome o = carom("run " + scene + dense + " --t-end 2 --quiet --strict -o out");
  EXPECT_EQ(o.status, 3);
  EXPECT_EQ(o.err.find("warning"), std::string::npos) << "the error has it: " << o.err;
  const std::string before = "carom: error: ";
  ASSERT_TRUE(o.err.starts_with(before)) << o.err;
  const std::string warning = o.err.substr(before.size(), o.err.find(" (--strict)") - before.size());
  const Outcome strict = carom("resume out --quiet --strict");
  EXPECT_EQ(strict.status, 3);
  EXPECT_THAT(strict.err, HasSubstr(warning));
  EXPECT_EQ(carom("resume out --quiet").status, 0);
  // The summary has the figures of the whole run, which are worse by then.
  const std::string reason = "collisions were seen a step late: dt = 0.05";
  EXPECT_THAT(warning, HasSubstr(reason));
  EXPECT_THAT(text_of(at("out/summary.json")), HasSubstr(reason));
}

TEST_F(InterruptedRun, ASignalStopsWithACheckpoint) {
  write("long.toml", test::busy_scene("pairwise", "checkpoint = \"1 h\"\n"));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    fs::remove_all(at("out"));  // otherwise the file of the last round would be taken for this one's
    const pid_t run = start({"run", "long.toml", "--t-end", "1e6", "-o", "out", "--quiet"});
    await(at("out/carom-unfinished/series.csv"));
    kill(run, signal);
    EXPECT_EQ(wait_for(run), 4);
    EXPECT_TRUE(fs::exists(at("out/carom-unfinished/checkpoint.carom")));
    EXPECT_THAT(said(), HasSubstr(std::string("stopped by SIG") + sigabbrev_np(signal) + " at t = "));
  }
  const Outcome o = carom("run long.toml -o out");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("resume it with carom resume out, choose another folder"));
}

TEST_F(InterruptedRun, SigusrWritesOneAndTheRunGoesOn) {
  const pid_t run = start({"run", "busy.toml", "--t-end", "1e6", "-o", "out"});
  await(at("out/carom-unfinished/series.csv"));
  EXPECT_FALSE(fs::exists(at("out/carom-unfinished/checkpoint.carom"))) << "no checkpoint was requested";
  kill(run, SIGUSR1);
  await(at("out/carom-unfinished/checkpoint.carom"));
  const Outcome o = carom("resume out");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.err, HasSubstr("another run is writing there"));
  EXPECT_EQ(carom("run busy.toml -o out --force").status, 2) << "not even with --force";
  kill(run, SIGKILL);
  EXPECT_EQ(wait_for(run), -SIGKILL);
  EXPECT_EQ(carom("resume out --quiet --max-walltime 1e-9").status, 4);
}

TEST_F(InterruptedRun, WithoutFilesOfItsOwnItMakesAFolderForTheCheckpoint) {
  const std::string bare =
      "run busy.toml --quiet --set output.trajectory=none --set output.series=false --set output.plots='[]' ";
  fs::create_directories(at("out/busy"));
  write("out/busy/series.csv", "of another program");
  const Outcome o = carom(bare + "--max-walltime 1e-9 --json");
  EXPECT_EQ(o.status, 4);
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json["resume_with"], "carom resume out/busy-2");
  EXPECT_LT(json["time"], 20.0);
  EXPECT_EQ(carom("resume out/busy-2 --quiet").status, 0);
  ASSERT_EQ(carom(bare + "-o whole").status, 0);
  EXPECT_EQ(summary("whole"), summary("out/busy-2"));
}

// The command in the message can be given to a shell as it is.
TEST_F(InterruptedRun, WhatGoesOnIsQuotedForTheShell) {
  const Outcome stopped = carom("run busy.toml -o \"it's 1\" --max-walltime 1e-9 --json");
  ASSERT_EQ(stopped.status, 4);
  const std::string command = nlohmann::json::parse(stopped.out)["resume_with"];
  EXPECT_EQ(command, R"(carom resume 'it'\''s 1')");
  EXPECT_THAT(stopped.err, HasSubstr("; resume it with " + command + "\n"));
  EXPECT_THAT(carom("run busy.toml -o \"it's 1\"").err,
              HasSubstr("; resume it with " + command + ", choose another folder"));
  const Outcome on = shell(R"(carom() { "$C" "$@"; }; )" + command + " --t-end 0.1 --quiet");
  EXPECT_EQ(on.status, 0) << on.err;
  EXPECT_TRUE(fs::exists(at("it's 1/summary.json")));
  EXPECT_THAT(carom("resume \"it's 1\"").err, HasSubstr(R"(carom run 'it'\''s 1/scene.toml' --set)"));
}

TEST_F(InterruptedRun, AFullDiskCostsNothingButTime) {
  write("small.toml", test::busy_scene("pairwise", "checkpoint = 0.02\n"));
  ASSERT_EQ(carom("run small.toml --quiet -o whole --t-end 10").status, 0);
  // The limit on the size of a file, in blocks of 512 bytes, acts like a full disk on the trajectory.
  Outcome o = shell("ulimit -f 400; $C run small.toml --quiet -o out --t-end 10");
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.err,
            "carom: error: cannot write out/carom-unfinished/trajectory.xyz: File too large; the last checkpoint is "
            "intact: carom resume out\n");
  o = shell("ulimit -f 401; $C resume out --quiet");
  EXPECT_EQ(o.status, 1) << "the disk is still full";
  EXPECT_THAT(o.err, HasSubstr("the last checkpoint is intact: carom resume out\n"));
  // Now there is no room even for the checkpoint itself.
  o = shell("ulimit -f 20; $C resume out --quiet");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.err, HasSubstr("the last checkpoint is intact: carom resume out\n"));
  EXPECT_EQ(carom("resume out --quiet").status, 0);
  expect_same_results("whole", "out");
}

TEST_F(InterruptedRun, AFullDiskThatTakesNoCopyIsNamed) {
  write("small.toml", test::busy_scene("pairwise", "checkpoint = \"1 h\"\n"));
  ASSERT_EQ(carom("run small.toml --quiet -o out --t-end 1").status, 0);
  const Outcome o = shell("ulimit -f 2; $C resume out --quiet --t-end 2 -o copy");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.err,
              StartsWith("carom: error: cannot copy out/trajectory.xyz to copy/carom-unfinished/trajectory.xyz: "));
  EXPECT_FALSE(fs::exists(at("copy"))) << "no part of it may be left";
}

TEST_F(InterruptedRun, ACheckpointThatWasCutShortIsRefusedAndTheOneBeforeServes) {
  // There are two checkpoints: that of the start and that of the stop.
  write("small.toml", test::busy_scene("pairwise", "checkpoint = \"1 h\"\n"));
  ASSERT_EQ(carom("run small.toml --quiet -o whole --t-end 10").status, 0);
  ASSERT_EQ(carom("run small.toml --quiet -o out --t-end 10 --max-walltime 1e-9").status, 4);
  const fs::path newest = at("out/carom-unfinished/checkpoint.carom");
  fs::resize_file(newest, fs::file_size(newest) / 2);
  const std::string before = test::text_of(at("out/carom-unfinished/series.csv"));
  const Outcome o = carom("resume out");
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.err,
            "carom: error: out/carom-unfinished/checkpoint.carom: is damaged: it was cut short or changed after it was "
            "written; the earlier one is intact: carom resume out/carom-unfinished/checkpoint.previous.carom\n");
  EXPECT_EQ(test::text_of(at("out/carom-unfinished/series.csv")), before) << "nothing may change";
  fs::create_directories(at("alone"));
  fs::copy_file(newest, at("alone/checkpoint.carom"));
  EXPECT_EQ(carom("resume alone").err,
            "carom: error: alone/checkpoint.carom: is damaged: it was cut short or changed after it was written; there "
            "is no intact earlier one, so run the scene again\n");
  EXPECT_EQ(carom("resume out/carom-unfinished/checkpoint.previous.carom --quiet").status, 0);
  expect_same_results("whole", "out");
}

TEST_F(InterruptedRun, OutputsThatAreGoneAreMissed) {
  ASSERT_EQ(carom("run busy.toml --quiet -o out --max-walltime 1e-9").status, 4);
  fs::resize_file(at("out/carom-unfinished/trajectory.xyz"), 1000);
  EXPECT_THAT(carom("resume out").err, HasSubstr("trajectory.xyz: has 1000 bytes; expected "));
  fs::remove(at("out/carom-unfinished/trajectory.xyz"));
  EXPECT_THAT(carom("resume out").err, HasSubstr("trajectory.xyz: No such file or directory; expected the file that"));
  EXPECT_TRUE(fs::exists(at("out/carom-unfinished/checkpoint.carom")));
}

// A scene.toml that was edited has no effect on the resumed run, and is not replaced without a warning.
TEST_F(InterruptedRun, ASceneThatWasEditedIsNotThatOfTheCheckpoint) {
  write("scene.toml", test::busy_scene("exact", ""));
  EXPECT_EQ(carom("run scene.toml --quiet -o d --max-walltime 1e-9").status, 4);
  const std::string file = "d/carom-unfinished/scene.toml", kept = text_of(at(file));
  const std::string resume = "resume d --max-walltime 1e-9", told = "carom: warning: " + file + " has changed: ";
  EXPECT_THAT(carom(resume).err, Not(HasSubstr("has changed")));
  write(file, "# by hand\n" + kept);
  EXPECT_THAT(carom(resume).err, Not(HasSubstr("has changed"))) << "the same scene in other words";
  for (const std::string& other : {test::replaced(kept, "t_end = 20.0", "t_end = 30.0"), kept.substr(0, 100)}) {
    write(file, other);
    EXPECT_THAT(carom(resume).err, StartsWith(told + "the run continues with the scene in its checkpoint\n"));
    EXPECT_EQ(text_of(at(file)), kept);
  }
}

// The run goes on with the engine of the checkpoint, unless another is named; a checkpoint of another version of Carom
// is accepted with a warning.
TEST_F(LongInterruptedRun, WhatACheckpointSaysOfItselfCounts) {
  ASSERT_EQ(carom("run busy.toml --quiet -o out --engine reference --max-walltime 1e-9").status, 4);
  const std::string file = at("out/carom-unfinished/checkpoint.carom").string();
  Checkpoint checkpoint = read_checkpoint(file);
  checkpoint.record.version = "0.0.7";
  write_checkpoint(file, checkpoint.record, checkpoint.state);
  const std::string warning = "warning: out was written by Carom 0.0.7; ";
  const Outcome o = carom("resume out --json");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr(warning));
  EXPECT_THAT(o.out, HasSubstr("\"engine\": \"reference\""));
}

TEST_F(LongInterruptedRun, IntoAnotherFolderItLeavesTheFirstAsItWas) {
  ASSERT_EQ(carom("run busy.toml --quiet -o whole").status, 0);
  ASSERT_EQ(carom("run busy.toml --quiet -o out --max-walltime 1e-9").status, 4);
  const std::string before = test::text_of(at("out/carom-unfinished/trajectory.xyz"));
  EXPECT_EQ(carom("resume out/carom-unfinished/checkpoint.carom --quiet -o copy").status, 0);
  expect_same_results("whole", "copy");
  EXPECT_EQ(test::text_of(at("out/carom-unfinished/trajectory.xyz")), before);
  EXPECT_EQ(carom("resume out -o whole").status, 2) << "results must not be replaced";
  EXPECT_EQ(carom("resume out --quiet").status, 0);
  expect_same_results("whole", "out");
}

TEST_F(LongInterruptedRun, AFinishedRunGoesOnToALaterEnd) {
  write("asks.toml", test::busy_scene("pairwise", "checkpoint = \"1 h\"\nplots = [\"energy\"]\nmovie = true\n"));
  const std::string seldom = " --quiet --set output.every=1.0";
  ASSERT_EQ(carom("run asks.toml -o whole --t-end 6" + seldom).status, 0);
  ASSERT_EQ(carom("run asks.toml -o out --t-end 3" + seldom).status, 0);
  EXPECT_TRUE(fs::exists(at("out/checkpoint.carom")));
  EXPECT_THAT(carom("resume out").err, HasSubstr("the run is finished: it ended at t = 3; expected a later --t-end"));
  EXPECT_THAT(carom("resume out --t-end 2").err,
              HasSubstr("--t-end: is 2; expected at least 3, the time of the checkpoint"));
  EXPECT_THAT(carom("resume out --t-end 3.0000000001").err, HasSubstr("expected at least a step of 0.002 after 3"));
  EXPECT_TRUE(fs::exists(at("out/summary.json"))) << "a refused resume must change nothing";
  EXPECT_EQ(carom("resume out --quiet --t-end 6").status, 0);
  expect_same_results("whole", "out");
  EXPECT_EQ(nlohmann::json::parse(test::text_of(at("out/summary.json")))["resumed"], 1);
  fs::remove(at("out/checkpoint.carom"));
  EXPECT_THAT(carom("resume out --t-end 9").err, HasSubstr("out: lacks its checkpoint.carom; the earlier one is there: "
                                                           "carom resume out/checkpoint.previous.carom --t-end T"));

  // Without a checkpoint, or after a last step that was cut short, only a new run can get further, and the message says
  // so.
  ASSERT_EQ(carom("run busy.toml -o bare --t-end 3" + seldom).status, 0);
  EXPECT_THAT(carom("resume bare --t-end 6").err,
              HasSubstr("bare: holds a finished run that kept no checkpoint; to go further, run it again with one: "
                        "carom run bare/scene.toml --set output.checkpoint=600 --t-end T -o DIR\n"));
  ASSERT_EQ(carom("run asks.toml -o cut --set output.movie=false --t-end 3.001" + seldom).status, 0);
  EXPECT_THAT(carom("resume cut --t-end 6").err,
              HasSubstr("the last step of the run was shortened to end at 3.001; expected an earlier checkpoint, or a "
                        "new run to the later end: carom run cut/scene.toml --t-end 6 -o DIR\n"))
      << "the scene file of the folder includes the changes by options";
}

TEST_F(InterruptedRun, OptionsOfResumeAreKept) {
  ASSERT_EQ(carom("run busy.toml --quiet -o out --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume out --quiet --t-end 22 --max-walltime 1e-9").status, 4);
  ASSERT_EQ(carom("resume out --quiet").status, 0);
  EXPECT_EQ(summary("out")["time"], 22.0);
}

// With one disk at rest the first window is the whole run, and its frames take some seconds.
TEST_F(LongInterruptedRun, AStopAmongMillionsOfFramesSaysWhatItWaitsFor) {
  write("rest.toml", R"([box]
width = 10.0
height = 10.0
[[disks]]
count = 1
positions = [[5.0, 5.0]]
radius = 0.5
mass = 1.0
[run]
t_end = 10.0
[output]
every = 5e-6
series = true
)");
  const Outcome o = shell(
      "$C run rest.toml -o out >/dev/null & P=$!; until [ -e out/carom-unfinished/series.csv ]; do sleep 0.01; done; "
      "kill -TERM $P; wait $P");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err,
            "carom: stops when the frames of this window are made, up to t = 10; another Ctrl-C, or SIGINT, ends it at "
            "once\n");
  const Outcome late = carom("run rest.toml -o late --max-walltime 0.2");
  EXPECT_EQ(late.status, 0);
  EXPECT_THAT(late.err, HasSubstr("up to t = 10; Ctrl-C, or SIGINT, twice ends it at once\n")) << "before any signal";
}

}  // namespace
}  // namespace carom
