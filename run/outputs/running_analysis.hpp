// The measurements of a run, from the first sample to the file and the plots.
#pragma once

#include <string>

#include "core/base/block_runner.hpp"
#include "core/base/wall_clock.hpp"
#include "core/measure/analysis.hpp"
#include "core/step/engine.hpp"
#include "io/files/output_folder.hpp"

namespace carom {

class RunningAnalysis {
 public:
  // run: the runner for the work of a sample. folder: null if the analysis is only for the summary, and nothing is
  // written or drawn. Precondition: scene.analysis.any(). scene and folder must outlive it.
  RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run);

  // Continues from the record of a checkpoint. Throws InputError if it does not belong to the scene.
  RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run, AnalysisRecord from);

  // To be called after each step, and before a frame or sample at time t.
  void follow(const Engine& engine, double t);

  // Adds a sample, and writes analysis.h5 now and then. Throws RunError if that fails.
  void sample(const DisksInPieces& disks, const State& now);

  // Mean square displacement of the disks of a frame; NaN before the first sample.
  double displacement(const DisksInPieces& disks);

  const AnalysisRecord& record() const { return record_; }
  double last_time() const { return record_.series.time.back(); }  // of the last sample, if there is one

  // Precondition, of this and the next: there is a folder.
  void write();

  // One plot for each quantity. Returns false, and draws nothing, where gnuplot is not installed.
  bool draw() const;

  // One line, each once, or empty.
  std::string take_warning();

 private:
  const Scene& scene_;
  const OutputFolder* folder_;
  BlockRunner run_;
  AnalysisRecord record_;
  WallClock::time_point written_{};
  bool warned_ = false;          // about moves too long to follow
  bool warned_of_none_ = false;  // about a first sample without disks
};

}  // namespace carom
