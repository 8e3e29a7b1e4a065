#include "run/loop/checkpoint_keeper.hpp"

#include <fmt/format.h>

#include <ctime>
#include <utility>

#include "io/checkpoint/checkpoint_place.hpp"
#include "io/files/shell_word.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

CheckpointKeeper::CheckpointKeeper(RunRecord record, WallClock::time_point started, double interval,
                                   double max_walltime)
    : before_(std::move(record)),
      started_(started),
      interval_(interval),
      max_walltime_(max_walltime),
      due_(interval > 0.0 ? seconds() + interval : infinity) {}

void CheckpointKeeper::write_to(OutputFolder* folder, RunOutputs* outputs, bool there) {
  folder_ = folder;
  if (there) written_to_ = folder->name();
  outputs_ = outputs;
}

OutputFolder& CheckpointKeeper::folder() {
  if (folder_ == nullptr) {
    folder_ = &own_folder_.emplace(usual_output_folder(before_.scene_file), before_.scene_file);
  }
  return *folder_;
}

bool CheckpointKeeper::look(const Engine& engine, double t_end, double step_s) {
  const double time = engine.progress().time;
  if (time >= t_end) return true;  // the run is over and needs no checkpoint
  const Wish wish = take_wish();
  const double now = seconds();
  if (wish == Wish::stop) {
    stopped_by_ = stop_signal_name();
  } else if (now > max_walltime_) {
    stopped_by_ = "--max-walltime";
  } else if (!asked_.empty()) {
    stopped_by_ = asked_;
    if (folder_ == nullptr) return false;
  }
  const bool stop = !stopped_by_.empty();
  if (!stop && wish == Wish::nothing && now < due_) return true;
  write(engine, step_s);
  if (wish == Wish::checkpoint) note_ = fmt::format("checkpoint at t = {:g}; {}", time, resume_command());
  return !stop;
}

bool CheckpointKeeper::wants_stop() const {
  return stop_wished() || seconds() > max_walltime_;
}

void CheckpointKeeper::write(const Engine& engine, double step_s) {
  write(engine, step_s, outputs_ != nullptr ? outputs_->mark() : OutputMark{});
}

void CheckpointKeeper::write(const Engine& engine, double step_s, OutputMark mark) {
  RunRecord now = record(step_s);
  now.outputs = std::move(mark);
  save_checkpoint(folder().unfinished(), now, *engine.pieces());
  written_to_ = folder().name();
  folder().keep_unfinished();
  if (interval_ > 0.0) due_ = seconds() + interval_;
}

RunRecord CheckpointKeeper::record(double step_s) const {
  RunRecord now = before_;
  now.wall_s += seconds();
  now.cpu_s += cpu_seconds();
  now.step_s += step_s;
  return now;
}

std::string CheckpointKeeper::resume_command() const {
  return written_to_.empty() ? "" : fmt::format("carom resume {}", shell_word(written_to_));
}

void CheckpointKeeper::discard_own_folder() {
  if (own_folder_) own_folder_->discard();
}

std::string CheckpointKeeper::take_note() {
  return std::exchange(note_, {});
}

}  // namespace carom
