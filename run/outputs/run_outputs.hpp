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

// What a run warns of where these programs are not installed.
inline constexpr const char* without_ffmpeg =
    "ffmpeg is not installed: the movie becomes frames/frame_000001.png and so on";
inline constexpr const char* without_gnuplot = "gnuplot is not installed: no plots are drawn";

// Has a run come to t_end, or did it stop before?
enum class RunEnd : std::uint8_t { whole, early };

class RunOutputs {
 public:
  // Opens the files in the folder. run: shares out the work of a frame or sample; the files are the same. Throws
  // RunError where a file cannot be written, here and below.
  RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, DiskId next_id = 0);

  // Goes on behind a mark: cuts back what came after it. Precondition: files_of(from) are in folder.unfinished().
  RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, const OutputMark& from, DiskId next_id);

  // To be called after each step, and before a frame or a sample at time t: how often disks go round periodic sides.
  void follow(const Engine& engine, double t);
  bool follows() const;  // whether that changes anything

  // now: of the run, all but its disks.
  void frame(const DisksInPieces& disks, const State& now);

  RunOutputs(const RunOutputs&) = delete;  // the trajectory refers to the counts of rounds
  RunOutputs& operator=(const RunOutputs&) = delete;

  // What scene.analysis measures; null where it asks for nothing.
  RunningAnalysis* analysis() const { return analysis_.get(); }

  // Brings all that was written onto the disk and says where it stands. Between two frames, whenever wanted.
  OutputMark mark();

  // Completes all files. After a run that stopped early no plots are drawn. Returns the mark from which a longer run
  // could go on, if the scene asks for checkpoints or a plot was lost.
  OutputMark finish(RunEnd end);

  // Pictures that gnuplot or ffmpeg failed to make cost the run nothing else: what failed, one entry each.
  const std::vector<std::string>& lost_plots() const { return lost_plots_; }
  const std::string& lost_movie() const { return lost_movie_; }  // empty if it was not

  // Ends writing where a later run will go on from the last mark.
  void pause();

  Count frames() const { return frames_; }
  double last_time() const { return last_time_; }  // simulated, of the last frame

  // What could not be made as asked, one line each; asked for once, it is gone.
  std::vector<std::string> take_warnings();

 private:
  OutputMark mark_without_movie();
  bool shows_rounds() const;
  XyzPlan xyz_plan() const;
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
  SeriesMeter meter_;  // for trajectory.h5 and energy.svg where there is no series.csv
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
