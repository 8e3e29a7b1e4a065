// When checkpoints are written between steps, and when a run has to stop.
#include "run/loop/checkpoint_keeper.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <thread>

#include "io/files/checkpoint_names.hpp"
#include "tests/support/scripted_engine.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

namespace fs = std::filesystem;

// An engine at time 0.5 with one disk, which does not advance.
class Standing : public test::ScriptedEngine {
 public:
  Standing() {
    append(state_.disks, {1.0, 1.0, 0.0, 0.0, 0.1, 1.0, 0});
    state_.next_id = 1;
    state_.time = 0.5;
  }
  void step() override {}
};

constexpr double never_up = std::numeric_limits<double>::infinity();

// After each checkpoint the interval starts anew. On a busy machine one interval may pass before the next call, but not
// five.
TEST(LongCheckpointKeeper, WritesOneAnIntervalAndNoMore) {
  const test::TestFolder place("keeper");
  OutputFolder folder((place.path() / "out").string(), "keeper.toml", false);
  const Standing engine;
  constexpr double interval = 0.4;
  CheckpointKeeper keeper({}, WallClock::now(), interval, never_up);
  keeper.write_to(&folder, nullptr, false);
  std::this_thread::sleep_for(std::chrono::duration<double>(interval));
  EXPECT_TRUE(keeper.look(engine, 1.0, 0.0));
  const fs::path file = fs::path(folder.unfinished()) / checkpoint_name;
  EXPECT_TRUE(fs::exists(file));
  bool spared = false;
  for (int k = 0; k < 5; ++k) {
    fs::remove(file);
    EXPECT_TRUE(keeper.look(engine, 1.0, 0.0));
    spared = spared || !fs::exists(file);
  }
  EXPECT_TRUE(spared);
}

// The time that a run has taken is the sum over its parts.
TEST(CheckpointKeeper, AddsToWhatEarlierPartsTook) {
  RunRecord before;
  before.wall_s = 10.0;
  before.cpu_s = 20.0;
  before.step_s = 30.0;
  const CheckpointKeeper keeper(before, WallClock::now(), 0.0, never_up);
  const RunRecord now = keeper.record(2.0);
  EXPECT_GT(now.wall_s, 10.0);
  EXPECT_GT(now.cpu_s, 20.0);
  EXPECT_EQ(now.step_s, 32.0);
}

// A run at its end is over, even if there is a reason to stop it.
TEST(CheckpointKeeper, StopsNoRunThatIsOver) {
  const test::TestFolder place("keeper");
  OutputFolder folder((place.path() / "out").string(), "keeper.toml", false);
  const Standing engine;
  CheckpointKeeper keeper({}, WallClock::now(), 0.0, 0.0);
  keeper.write_to(&folder, nullptr, false);
  EXPECT_TRUE(keeper.look(engine, 0.5, 0.0));
  EXPECT_EQ(keeper.stopped_by(), "");
  EXPECT_FALSE(keeper.look(engine, 1.0, 0.0));
  EXPECT_EQ(keeper.stopped_by(), "--max-walltime");
}

// A caller that wants to stop gets a checkpoint if there is a folder for it; no folder is made.
TEST(CheckpointKeeper, MakesNoFolderForACallerThatAsksToStop) {
  const Standing engine;
  RunRecord record;
  record.scene_file = "a_keeper_without_a_folder.toml";
  CheckpointKeeper keeper(record, WallClock::now(), 0.0, never_up);
  keeper.ask_to_stop("Ctrl-C");
  EXPECT_FALSE(keeper.look(engine, 1.0, 0.0));
  EXPECT_EQ(keeper.stopped_by(), "Ctrl-C");
  EXPECT_EQ(keeper.resume_command(), "");
  keeper.discard_own_folder();
}

// It is called within steps, so that a long step can be left before its end.
TEST(CheckpointKeeper, WantsToStopWhereTheTimeIsUp) {
  EXPECT_TRUE(CheckpointKeeper({}, WallClock::now(), 0.0, 0.0).wants_stop());
  EXPECT_FALSE(CheckpointKeeper({}, WallClock::now(), 0.0, never_up).wants_stop());
}

// A run without results gets a folder only for its checkpoint. The folder stays if the run stops, and is removed if the
// run comes to its end.
TEST(CheckpointKeeper, TakesTheFolderThatItMadeAwayWhereTheRunEnds) {
  const test::TestFolder place("keeper");
  const fs::path here = fs::current_path();
  fs::current_path(place.path());
  RunRecord record;
  record.scene_file = "alone.toml";
  const fs::path file = fs::path("out") / "alone" / unfinished_name / checkpoint_name;
  for (const bool ends : {true, false}) {
    {
      CheckpointKeeper keeper(record, WallClock::now(), 0.0, 0.0);
      EXPECT_FALSE(keeper.look(Standing(), 1.0, 0.0));
      EXPECT_TRUE(fs::exists(file));
      EXPECT_EQ(keeper.resume_command(), "carom resume out/alone");
      if (ends) keeper.discard_own_folder();
    }
    EXPECT_EQ(fs::exists(file), !ends);
    EXPECT_EQ(fs::exists("out"), !ends);
  }
  fs::current_path(here);
}

}  // namespace
}  // namespace carom
