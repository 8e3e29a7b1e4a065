// What a run measures on its way, from the first sample to the file and the plots.
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
  // run: shares out the work of a sample. folder: null where it is for the summary alone, and nothing is written or
  // drawn. Precondition: scene.analysis.any(). scene and folder must outlive it.
  RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run);

  // Goes on from what was gathered up to a checkpoint. Throws InputError where it does not go with the scene.
  RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run, AnalysisRecord from);

  // To be called after each step, and before a frame or sample at time t.
  void follow(const Engine& engine, double t);

  // Writes analysis.h5 now and then. Throws RunError where it cannot.
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
  bool warned_ = false;          // of moves too long to follow
  bool warned_of_none_ = false;  // of a first sample without disks
};

}  // namespace carom
