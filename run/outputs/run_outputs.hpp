// All files that a scene asks for, fed frame by frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/step/engine.hpp"
#include "io/checkpoint/output_mark.hpp"
#include "io/files/output_folder.hpp"
#include "io/movie/movie.hpp"
#include "io/plots/plot.hpp"
#include "io/tables/series.hpp"
#include "io/trajectory/trajectory_h5md.hpp"
#include "io/trajectory/trajectory_xyz.hpp"
#include "run/outputs/running_analysis.hpp"

namespace carom {

// Whether a scene asks for any file at all.
bool wants_files(const Scene& scene);

// Does the trajectory tell how often disks have gone round the periodic sides? In a shear flow rounds have no meaning:
// a disk that crosses the top and comes back has moved along x.
bool shows_rounds(const Scene& scene);

// What trajectory.xyz holds. rounds: those of its disks, if it shows them; the plan refers to them.
XyzPlan xyz_plan(const Scene& scene, const DisplacementTally* rounds);

// The warnings of a run if these programs are not installed.
inline constexpr const char* without_ffmpeg =
    "ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on";
inline constexpr const char* without_gnuplot = "gnuplot is not installed: no plots are drawn";

// Has a run come to t_end, or did it stop before?
enum class RunEnd : std::uint8_t { whole, early };

class RunOutputs {
 public:
  // Opens the files in the folder. run: the runner for the work of a frame or sample; it does not change the files.
  // Throws RunError if a file cannot be written, here and below.
  RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, DiskId next_id = 0);

  // Continues after a mark: later data are cut off. Precondition: files_of(from) are in folder.unfinished().
  RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, const OutputMark& from, DiskId next_id);

  // To be called after each step, and before a frame or a sample at time t: counts the rounds of disks across periodic
  // sides.
  void follow(const Engine& engine, double t);
  bool follows() const;  // does that have any effect?

  // now: the state of the run; its disks are not used.
  void frame(const DisksInPieces& disks, const State& now);

  RunOutputs(const RunOutputs&) = delete;  // the trajectory refers to the counts of rounds
  RunOutputs& operator=(const RunOutputs&) = delete;

  // The analysis; null if the scene asks for none.
  RunningAnalysis* analysis() const { return analysis_.get(); }

  // Writes all data to the disk and returns the positions of all outputs. May be called between two frames at any time.
  OutputMark mark();

  // Completes all files. After a run that stopped early no plots are drawn. Returns the mark from which the run could
  // be continued, if the scene asks for checkpoints or a plot was lost.
  OutputMark finish(RunEnd end);

  // The pictures that gnuplot or ffmpeg failed to make; such failures do not stop the run.
  const std::vector<std::string>& lost_plots() const { return lost_plots_; }
  const std::string& lost_movie() const { return lost_movie_; }  // empty if it was not

  // Stops writing; a resumed run will continue from the last mark.
  void pause();

  Count frames() const { return frames_; }
  double last_time() const { return last_time_; }  // simulated, of the last frame

  // Warnings about outputs that could not be made as asked, one line each; each is returned once.
  std::vector<std::string> take_warnings();

 private:
  OutputMark mark_without_movie();
  void remove_old_pictures();
  void draw_plots();
  bool draw(const std::function<bool()>& plot);  // false: there is no gnuplot
  void add_to_movie(const DisksInPieces& disks);
  void lose_movie(const std::string& why);

  const Scene& scene_;
  const OutputFolder& folder_;
  BlockRunner run_;
  Count frames_ = 0;
  Count frames_before_ = 0;  // those of earlier parts of the run
  double last_time_ = 0.0;
  DisplacementTally rounds_;  // of the disks in a trajectory; begins with its first frame
  bool doubt_told_ = false;
  std::unique_ptr<XyzWriter> trajectory_;
  std::unique_ptr<H5mdWriter> h5md_;
  SeriesMeter meter_;  // for trajectory.h5 and energy.svg if there is no series.csv
  std::unique_ptr<SeriesWriter> series_;
  std::unique_ptr<RunningAnalysis> analysis_;
  std::unique_ptr<MovieWriter> movie_;  // from the first frame on, which sets its colour scale
  bool plot_velocity_ = false, plot_energy_ = false;
  VelocityRecord velocities_;
  EnergyRecord energies_;
  std::vector<std::string> warnings_;
  std::vector<std::string> lost_plots_;
  std::string lost_movie_;
};

}  // namespace carom
