// All files that a scene asks for, fed frame by frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine.hpp"
#include "io/movie.hpp"
#include "io/output_folder.hpp"
#include "io/plot.hpp"
#include "io/series.hpp"
#include "io/trajectory_h5md.hpp"
#include "io/trajectory_xyz.hpp"

namespace carom {

// Whether a scene asks for any file that is made of frames.
bool wants_frames(const OutputPlan& plan);

class RunOutputs {
 public:
  // Opens the files in the folder. Throws RunError where one cannot be written, here and below.
  RunOutputs(const Scene& scene, const OutputFolder& folder);

  void frame(const Disks& disks, double time, const State& now);

  // Completes all files. After a run that stopped early (whole = false) no plots are drawn.
  void finish(bool whole);

  Count frames() const { return frames_; }

  // What could not be made as asked, one line each; asked for once, it is gone.
  std::vector<std::string> take_warnings();

 private:
  void draw_plots();

  const Scene& scene_;
  const OutputFolder& folder_;
  Count frames_ = 0;
  std::unique_ptr<XyzWriter> trajectory_;
  std::unique_ptr<H5mdWriter> h5md_;
  SeriesMeter meter_;  // for trajectory.h5 where there is no series.csv
  std::unique_ptr<SeriesWriter> series_;
  std::unique_ptr<MovieWriter> movie_;  // from the first frame on, which sets its colour scale
  bool plot_velocity_ = false, plot_energy_ = false;
  VelocityRecord velocities_;
  EnergyRecord energies_;
  std::vector<std::string> warnings_;
};

}  // namespace carom
