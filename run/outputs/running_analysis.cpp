#include "run/outputs/running_analysis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/measure/follow_disks.hpp"
#include "core/scene/scene_names.hpp"
#include "io/plots/analysis_plots.hpp"
#include "io/tables/analysis_file.hpp"

namespace carom {

namespace {

// Often enough to show the progress of a long run, rarely enough to cost next to nothing.
constexpr std::chrono::seconds write_interval{5};

// Does the first sample, if there is one, have no disk?
bool begins_empty(const AnalysisRecord& record) {
  return !record.series.disks.empty() && record.series.disks.front() == 0.0;
}

// The quantities, among those that the scene asks for, that follow disks from the first sample on.
std::vector<std::string_view> followed_names(const Scene& scene) {
  std::vector<std::string_view> names;
  for (const Quantity q :
       {Quantity::displacement, Quantity::velocity_autocorrelation, Quantity::bond_autocorrelation}) {
    if (scene.analysis.wants(q)) names.push_back(quantity_names[static_cast<std::size_t>(q)]);
  }
  return names;
}

}  // namespace

RunningAnalysis::RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run)
    : scene_(scene), folder_(folder), run_(std::move(run)), record_(empty_record(scene)) {}

RunningAnalysis::RunningAnalysis(const Scene& scene, const OutputFolder* folder, BlockRunner run, AnalysisRecord from)
    : scene_(scene),
      folder_(folder),
      run_(std::move(run)),
      record_(std::move(from)),
      warned_(record_.displacement.doubtful > 0),
      warned_of_none_(begins_empty(record_)) {
  if (!goes_with(record_, scene)) {
    throw InputError(
        "the checkpoint's analysis does not belong to its scene; expected the checkpoint that the run wrote");
  }
}

void RunningAnalysis::follow(const Engine& engine, double t) {
  if (!scene_.analysis.wants(Quantity::displacement)) return;
  if (follow_disks(record_.displacement, engine, scene_, t) && t == engine.progress().time) {
    Disks room;
    look_at(record_.displacement, *engine.pieces_at(t, room), scene_.box);
  }
}

void RunningAnalysis::sample(const DisksInPieces& disks, const State& now) {
  take_sample(record_, scene_, disks, now, run_);
  if (folder_ != nullptr && WallClock::now() - written_ > write_interval) write();
}

double RunningAnalysis::displacement(const DisksInPieces& disks) {
  if (!record_.displacement.begun) return std::numeric_limits<double>::quiet_NaN();
  look_at(record_.displacement, disks, scene_.box);
  return mean_square_displacement(record_.displacement, disks, scene_.box).value;
}

void RunningAnalysis::write() {
  write_analysis(folder_->path("analysis.h5"), scene_, record_);
  written_ = WallClock::now();
}

bool RunningAnalysis::draw() const {
  return draw_analysis(folder_->unfinished(), scene_, record_);
}

std::string RunningAnalysis::take_warning() {
  if (begins_empty(record_) && !std::exchange(warned_of_none_, true)) {
    const std::vector<std::string_view> names = followed_names(scene_);
    if (!names.empty()) {
      return fmt::format(
          "analysis: {} {} measured on the disks of the first sample, but at t = {:g} there are none; use a later "
          "analysis.start",
          fmt::join(names, ", "), names.size() == 1 ? "is" : "are", record_.series.time.front());
    }
  }
  if (warned_ || record_.displacement.doubtful == 0) return "";
  warned_ = true;
  return doubt_text(record_.displacement, scene_, "displacement", "the mean square displacement", "analysis.every");
}

}  // namespace carom
