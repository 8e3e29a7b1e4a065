// Decides when a run writes checkpoints: at intervals of wall time, on signals, when its time is up, and at its end.
#pragma once

#include <optional>
#include <string>

#include "core/base/wall_clock.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "io/files/output_folder.hpp"
#include "run/outputs/run_outputs.hpp"

namespace carom {

class CheckpointKeeper {
 public:
  // record: of the run so far, with the times of its earlier parts. started: when this process began. interval,
  // max_walltime: seconds; with interval 0 there are checkpoints only on request.
  CheckpointKeeper(RunRecord record, WallClock::time_point started, double interval, double max_walltime);

  // Sets the folder of checkpoints. Without one, out/NAME of the scene (or out/NAME-2 and so on) is made when the first
  // checkpoint is requested. outputs may be null. there: the folder has the checkpoint from which the run was resumed.
  void write_to(OutputFolder* folder, RunOutputs* outputs, bool there);

  // To be called between steps: writes a checkpoint if one is due or requested. Returns false if the run has to stop.
  // Throws RunError if it cannot be written; earlier checkpoints are kept.
  bool look(const Engine& engine, double t_end, double step_s);

  // The next look() is to stop the run for this reason, such as "Ctrl-C"; an empty one changes nothing. It then writes
  // a checkpoint only if the run has a folder.
  void ask_to_stop(const std::string& why) { asked_ = why; }

  // Has the run to stop, by a signal or because its time is up? May be called at any time, by any thread.
  bool wants_stop() const;

  // Writes a checkpoint now, in pieces: with several ranks no rank need hold all disks.
  void write(const Engine& engine, double step_s);
  void write(const Engine& engine, double step_s, OutputMark mark);

  // The record as it is now, for the summary; step_s is that of this process.
  RunRecord record(double step_s) const;

  // The reason why look() returned false, such as "SIGTERM"; empty if it did not.
  const std::string& stopped_by() const { return stopped_by_; }

  // The command to resume the run, such as "carom resume out/gas"; empty while there is no checkpoint.
  std::string resume_command() const;

  // To be called at the end of the run: removes a folder that was made only for checkpoints.
  void discard_own_folder();

  // The line for the user about a checkpoint that was requested; returned once.
  std::string take_note();

 private:
  double seconds() const { return seconds_since(started_); }
  OutputFolder& folder();

  RunRecord before_;
  WallClock::time_point started_;
  double interval_;
  double max_walltime_;
  double due_;  // seconds
  OutputFolder* folder_ = nullptr;
  std::optional<OutputFolder> own_folder_;
  RunOutputs* outputs_ = nullptr;
  std::string written_to_;  // the folder's name, kept after the folder is gone; empty: no checkpoint yet
  std::string asked_;       // the caller's reason to stop
  std::string stopped_by_;
  std::string note_;
};

// CPU time of all threads of this process so far, in seconds.
double cpu_seconds();

}  // namespace carom
