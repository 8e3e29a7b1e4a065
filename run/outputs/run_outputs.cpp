#include "run/outputs/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/base/check.hpp"
#include "core/measure/follow_disks.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/disk_group.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/scene_names.hpp"
#include "core/scene/scene_output.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

std::string plot_name(std::string_view plot) {
  return fmt::format("{}.svg", plot);
}

bool has_plot(const OutputPlan& plan, const char* name) {
  return std::find(plan.plots.begin(), plan.plots.end(), name) != plan.plots.end();
}

}  // namespace

bool wants_files(const Scene& scene) {
  return wants_frames(scene.output) || scene.analysis.any() || scene.output.checkpoint > 0.0;
}

bool shows_rounds(const Scene& scene) {
  return scene.output.trajectory != TrajectoryFormat::none && !scene.box.shear.acts() &&
         (scene.box.periodic_x() || scene.box.periodic_y());
}

// The group column is written if there are several groups, sources included.
XyzPlan xyz_plan(const Scene& scene, const DisplacementTally* rounds) {
  XyzPlan plan{scene.box, scene.output.select};
  plan.spins = scene.physics.surfaces.are_rough();
  plan.single = scene.output.single_precision;
  if (has_several_groups(scene)) plan.group_ends = ends_of_groups(scene);
  if (shows_rounds(scene)) plan.rounds = rounds;
  return plan;
}

RunOutputs::RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, DiskId next_id)
    : scene_(scene),
      folder_(folder),
      run_(std::move(run)),
      meter_(scene, false),
      plot_velocity_(has_plot(scene.output, "velocity")),
      plot_energy_(has_plot(scene.output, "energy") && !velocities_are_drawn(scene)) {
  if (scene.output.trajectory == TrajectoryFormat::xyz) {
    trajectory_ = std::make_unique<XyzWriter>(folder.path("trajectory.xyz"), xyz_plan(scene, &rounds_));
  }
  if (scene.output.trajectory == TrajectoryFormat::h5md) {
    h5md_ = std::make_unique<H5mdWriter>(folder.path("trajectory.h5"), scene, shows_rounds(scene) ? &rounds_ : nullptr,
                                         next_id);
  }
  if (scene.output.series) series_ = std::make_unique<SeriesWriter>(folder.path("series.csv"), scene);
  if (scene.analysis.any()) analysis_ = std::make_unique<RunningAnalysis>(scene, &folder, run_);
}

RunOutputs::RunOutputs(const Scene& scene, const OutputFolder& folder, BlockRunner run, const OutputMark& from,
                       DiskId next_id)
    : scene_(scene),
      folder_(folder),
      run_(std::move(run)),
      frames_(from.frames),
      frames_before_(from.frames),
      last_time_(from.last_time),
      rounds_(from.rounds),
      doubt_told_(from.rounds.doubtful > 0),
      meter_(scene, false, from.meter),
      plot_velocity_(has_plot(scene.output, "velocity")),
      plot_energy_(has_plot(scene.output, "energy") && !velocities_are_drawn(scene)),
      velocities_(from.velocities),
      energies_(from.energies) {
  if (from.trajectory) {
    const std::string path = folder.path(from.trajectory->name);
    if (scene.output.trajectory == TrajectoryFormat::h5md) {
      const DisplacementTally* const rounds = shows_rounds(scene) ? &rounds_ : nullptr;
      h5md_ = std::make_unique<H5mdWriter>(path, scene, from.trajectory->frames, rounds, next_id);
    } else {
      trajectory_ = std::make_unique<XyzWriter>(path, xyz_plan(scene, &rounds_), *from.trajectory);
    }
  }
  if (from.series) series_ = std::make_unique<SeriesWriter>(folder.path(from.series->file.name), scene, *from.series);
  if (scene.analysis.any()) {
    analysis_ =
        std::make_unique<RunningAnalysis>(scene, &folder, run_, from.analysis ? *from.analysis : empty_record(scene));
  }
  if (!from.movie) {
    if (scene.output.movie && from.frames > 0) lost_movie_ = "the movie broke off before the checkpoint";
    return;
  }
  FrameStyle style = frame_style(scene, scene.output.look, {});
  style.low = from.movie->low;
  style.high = from.movie->high;
  style.time_decimals = from.movie->time_decimals;
  movie_ = std::make_unique<MovieWriter>(folder_.unfinished(), style, *from.movie);
}

OutputMark RunOutputs::mark_without_movie() {
  OutputMark mark{frames_, last_time_, {}, {}, meter_.mark(), {}, velocities_, energies_, {}, rounds_};
  if (trajectory_) mark.trajectory = trajectory_->mark();
  if (h5md_) mark.trajectory = h5md_->mark();
  if (series_) mark.series = series_->mark();
  if (analysis_) mark.analysis = analysis_->record();
  return mark;
}

OutputMark RunOutputs::mark() {
  OutputMark mark = mark_without_movie();
  if (!movie_) return mark;
  try {
    mark.movie = movie_->mark();
  } catch (const RunError& error) {
    lose_movie(error.what());
    warnings_.push_back(fmt::format("{}; the run goes on without a movie", lost_movie_));
  }
  return mark;
}

bool RunOutputs::follows() const {
  const bool displacement = scene_.analysis.wants(Quantity::displacement);
  return shows_rounds(scene_) || (displacement && (scene_.box.periodic_x() || scene_.box.periodic_y()));
}

void RunOutputs::follow(const Engine& engine, double t) {
  if (analysis_) analysis_->follow(engine, t);
  if (!shows_rounds(scene_)) return;
  if (follow_disks(rounds_, engine, scene_, t) && t == engine.progress().time) {
    Disks room;
    look_at(rounds_, *engine.pieces_at(t, room), scene_.box);
  }
}

void RunOutputs::frame(const DisksInPieces& disks, const State& now) {
  const double time = disks.time();
  ++frames_;
  last_time_ = time;
  if (shows_rounds(scene_)) follow_rounds(rounds_, disks, scene_.box, run_);
  if (trajectory_) trajectory_->write(disks, run_);
  SeriesRow row{};
  if (series_) {
    const bool displacement = scene_.analysis.wants(Quantity::displacement);
    row = series_->write(disks, now, displacement ? analysis_->displacement(disks) : 0.0, run_);
  }
  if (!series_ && (h5md_ || plot_energy_)) row = meter_.row(disks, now, run_);
  if (h5md_) h5md_->write(disks, now.counters.steps, row, run_);
  if (plot_velocity_) record(velocities_, disks);
  if (plot_energy_) {
    energies_.t.push_back(time);
    energies_.kinetic.push_back(row[kinetic_column]);
    energies_.potential.push_back(row[potential_column]);
    energies_.total.push_back(row[total_column]);
  }
  if (scene_.output.movie && lost_movie_.empty()) add_to_movie(disks);
}

void RunOutputs::add_to_movie(const DisksInPieces& disks) {
  try {
    if (!movie_) {
      movie_ = std::make_unique<MovieWriter>(folder_.unfinished(),
                                             frame_style(scene_, scene_.output.look, foreseen_values(scene_, disks)));
      if (movie_->single_frames()) {
        warnings_.emplace_back(without_ffmpeg);
      }
    }
    movie_->add(disks);
  } catch (const RunError& error) {
    lose_movie(error.what());
    warnings_.push_back(fmt::format("{}; the run goes on without a movie", lost_movie_));
  }
}

void RunOutputs::lose_movie(const std::string& why) {
  lost_movie_ = why;
  movie_ = nullptr;
}

bool RunOutputs::draw(const std::function<bool()>& plot) {
  try {
    return plot();
  } catch (const RunError& error) {
    lost_plots_.emplace_back(error.what());
    return true;
  }
}

void RunOutputs::draw_plots() {
  bool drawn = true;
  if (plot_velocity_) {
    drawn = draw([&] { return plot_velocity(folder_.path("velocity.svg"), scene_.title, velocities_); });
  }
  if (plot_energy_ && drawn) {
    drawn = draw([&] { return plot_energy(folder_.path("energy.svg"), scene_.title, energies_); });
  }
  if (analysis_ && drawn) drawn = draw([&] { return analysis_->draw(); });
  if (!drawn) warnings_.emplace_back(without_gnuplot);
}

// Removes pictures made at an earlier end of this run. If they cannot be made anew, no picture is better than one that
// ends too early, and it can still be made from the other files. A movie without a trajectory cannot, so it is kept.
void RunOutputs::remove_old_pictures() {
  std::error_code ignored;
  for (const std::string& plot : scene_.output.plots) fs::remove(folder_.path(plot_name(plot)), ignored);
  for (std::size_t k = 0; k < quantity_names.size(); ++k) {
    if (scene_.analysis.wanted[k]) fs::remove(folder_.path(plot_name(quantity_names[k])), ignored);
  }
  const fs::path movie = folder_.path(movie_name(MovieFormat::mp4));
  if (lost_movie_.empty() || frames_ == frames_before_ || !fs::exists(movie, ignored)) return;
  if (scene_.output.trajectory != TrajectoryFormat::none) {
    fs::remove(movie, ignored);
  } else {
    lost_movie_ += fmt::format("; {} ends where the run ended before", movie.filename().string());
  }
}

OutputMark RunOutputs::finish(RunEnd end) {
  std::optional<MovieMark> movie;
  if (movie_) {
    try {
      movie = movie_->finish();
    } catch (const RunError& error) {
      lose_movie(error.what());
    }
  }
  if (end == RunEnd::whole) {
    remove_old_pictures();
    draw_plots();
  }
  OutputMark mark;
  if (scene_.output.checkpoint > 0.0 || !lost_plots_.empty()) mark = mark_without_movie();
  mark.movie = movie;
  pause();
  return mark;
}

void RunOutputs::pause() {
  if (trajectory_) trajectory_->close();
  if (h5md_) h5md_->close();
  if (series_) series_->close();
  if (analysis_) analysis_->write();
}

std::vector<std::string> RunOutputs::take_warnings() {
  std::vector<std::string> warnings = std::exchange(warnings_, {});
  const std::string doubt = analysis_ ? analysis_->take_warning() : "";
  if (!doubt.empty()) warnings.push_back(doubt);
  if (rounds_.doubtful > 0 && !std::exchange(doubt_told_, true)) {
    warnings.push_back(doubt_text(rounds_, scene_, "trajectory", "its counts of rounds", "output.every"));
  }
  return warnings;
}

}  // namespace carom
