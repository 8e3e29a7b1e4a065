// A run from its first step to its results.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/wall_clock.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "run/loop/checkpoint_keeper.hpp"
#include "run/loop/run_loop.hpp"
#include "run/scene/run_files.hpp"
#include "run/scene/run_scene.hpp"

namespace carom {

// Calls one of a listener's functions, unless it is empty.
template <class Function, class... Arguments>
void tell(const Function& function, const Arguments&... arguments) {
  if (function) function(arguments...);
}

void tell_all(const RunListener& listener, const std::vector<std::string>& warnings);

// All warnings of the run up to this state: of its start, and of the worst that has occurred.
std::vector<std::string> warnings_so_far(const RunRecord& record, const Scene& scene, const State& state);

// One run, with its engine, its files (if any) and its checkpoints.
class SceneRun {
 public:
  // goes_on: the run is continued from a checkpoint. disks: their number when it begins. The other arguments must
  // outlive it. files: null if there are none.
  SceneRun(const Scene& scene, const RunSettings& settings, Engine& engine, RunFiles* files, CheckpointKeeper& keeper,
           bool goes_on, Count disks);

  // Steps to the end with all outputs, progress and checkpoints, or until the keeper requests a stop.
  void go();

  // The results of a run that has stopped early, and of one at its end, with all files complete.
  RunOutcome stopped();
  RunOutcome finished();

 private:
  RunObserver observer();
  void say_what_a_stop_waits_for();
  void watch_samples(RunObserver& observer, const std::function<void(double)>& follow);
  RunningAnalysis* analysis() const { return files_ != nullptr ? files_->outputs.analysis() : measured_.get(); }
  void take_news(bool silent);
  bool pulse(double seconds);
  void take_output_warnings();
  [[noreturn]] void keep_stopped(const PhysicsError& error);
  Summary summary() const;
  std::vector<std::string> energy_gained() const;
  bool keep_last_checkpoint(const OutputMark& mark);
  std::string make_page();

  const Scene& scene_;
  const RunSettings& settings_;
  const RunListener& listener_;
  Engine& engine_;
  RunFiles* files_;
  CheckpointKeeper& keeper_;
  std::unique_ptr<RunningAnalysis> measured_;  // for the summary of a run without files
  bool goes_on_;
  Count disks_;                    // at the beginning
  double step_s_ = 0.0;            // seconds in steps
  std::vector<std::string> told_;  // warnings that the engine has given
  std::optional<WallClock::time_point> stop_seen_;
  bool wait_told_ = false;
};

}  // namespace carom
