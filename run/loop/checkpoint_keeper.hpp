// When a run writes checkpoints: in intervals of wall time, on signals, when its time is up, at its end.
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
  // record: of the run so far, with the times that its earlier parts spent. started: when this process began with it.
  // interval and max_walltime in seconds; an interval of 0 means none except on request.
  CheckpointKeeper(RunRecord record, WallClock::time_point started, double interval, double max_walltime);

  // Where they go. Without a folder one is made when the first checkpoint is requested: out/NAME of the scene, or
  // out/NAME-2 and so on where that is taken. outputs may be null. there: the folder holds the checkpoint that the run
  // goes on from.
  void write_to(OutputFolder* folder, RunOutputs* outputs, bool there);

  // To be called between steps: writes a checkpoint if one is due or requested. Returns false when the run is to stop.
  // Throws RunError where it cannot be written; the ones before stay.
  bool look(const Engine& engine, double t_end, double step_s);

  // The next look() is to stop the run for this reason, such as "Ctrl-C"; an empty one changes nothing. It then writes
  // a checkpoint only if the run has a folder.
  void ask_to_stop(const std::string& why) { asked_ = why; }

  // Is the run to stop, by a signal or since its time is up? To be asked at any time, by any thread.
  bool wants_stop() const;

  // Writes one now, piece by piece: an engine of several ranks need not have all disks on one of them.
  void write(const Engine& engine, double step_s);
  void write(const Engine& engine, double step_s, OutputMark mark);

  // The record as it is now, for the summary; step_s is that of this process.
  RunRecord record(double step_s) const;

  // Why look() returned false, such as "SIGTERM"; empty if it did not.
  const std::string& stopped_by() const { return stopped_by_; }

  // How to go on, such as "carom resume out/gas"; empty while there is no checkpoint.
  std::string resume_command() const;

  // The run is done: a folder that was made for its checkpoints alone goes.
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
  std::string written_to_;  // the folder's name, which outlives it; empty: no checkpoint yet
  std::string asked_;       // why the caller wants it to stop
  std::string stopped_by_;
  std::string note_;
};

// CPU time of all threads of this process so far, in seconds.
double cpu_seconds();

}  // namespace carom
