#include "run/scene/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/measure/energy_gain.hpp"
#include "core/scene/scene_output.hpp"
#include "core/step/late_collisions.hpp"
#include "core/step/validity.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_file.hpp"
#include "io/files/shell_word.hpp"
#include "run/engine/strict_engine.hpp"
#include "run/loop/stop_signals.hpp"
#include "run/recordings/run_view.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

// One line about the plots, movie and page that could not be made, and how to make them. lost_view: why there is no
// page.
std::string lost_pictures(const Scene& scene, const RunFiles& files, const std::string& lost_view, bool resumable) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const std::string& plot : files.outputs.lost_plots()) add(plot);
  const std::string& folder = files.folder.name();
  const std::string word = shell_word(folder);
  const std::string& movie = files.outputs.lost_movie();
  if (!movie.empty()) add(movie);
  if (!lost_view.empty()) add(lost_view);
  if (text.empty()) return text;
  add(fmt::format("all other results are in {}", folder));
  if (resumable && !files.outputs.lost_plots().empty()) add(fmt::format("carom resume {} draws the plots", word));
  if (!movie.empty() && scene.output.trajectory != TrajectoryFormat::none) {
    add(fmt::format("carom render {} makes the movie", word));
  }
  if (!lost_view.empty()) add(fmt::format("carom view {} makes the page", word));
  return text;
}

}  // namespace

void tell_all(const RunListener& listener, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) tell(listener.warning, warning);
}

std::vector<std::string> warnings_so_far(const RunRecord& record, const Scene& scene, const State& state) {
  std::vector<std::string> warnings = record.warnings;
  for (std::string& warning : validity_warnings_so_far(scene, state)) warnings.push_back(std::move(warning));
  return warnings;
}

SceneRun::SceneRun(const Scene& scene, const RunSettings& settings, Engine& engine, RunFiles* files,
                   CheckpointKeeper& keeper, bool goes_on, Count disks)
    : scene_(scene),
      settings_(settings),
      listener_(settings.listener),
      engine_(engine),
      files_(files),
      keeper_(keeper),
      goes_on_(goes_on),
      disks_(disks) {
  if (files_ != nullptr || goes_on_ || !scene_.analysis.any()) return;
  measured_ = std::make_unique<RunningAnalysis>(scene_, nullptr, make_block_runner(settings_.engine));
}

void SceneRun::take_news(bool silent) {
  const std::vector<std::string> news = engine_.take_warnings();
  if (!silent) tell_all(listener_, news);
  told_.insert(told_.end(), news.begin(), news.end());
}

bool SceneRun::pulse(double seconds) {
  step_s_ = seconds;
  take_news(false);
  tell(listener_.progress, engine_.progress());
  if (listener_.stop) keeper_.ask_to_stop(listener_.stop());
  const bool go_on = keeper_.look(engine_, scene_.run.t_end, seconds);
  const std::string note = keeper_.take_note();
  if (!note.empty()) tell(listener_.note, note);
  return go_on;
}

// Between two frames of a window there is no state for a stop: the window's start is gone, and the frames missing at
// its end could not be made from there. With millions of disks making them takes a while.
void SceneRun::say_what_a_stop_waits_for() {
  constexpr double patience_s = 1.0;
  if (wait_told_ || !keeper_.wants_stop()) return;
  if (!stop_seen_) stop_seen_ = WallClock::now();
  if (seconds_since(*stop_seen_) < patience_s) return;
  wait_told_ = true;
  // If the wall time has run out, a first signal requests the same stop again.
  const char* const how = stop_wished() ? "another Ctrl-C, or SIGINT, ends" : "Ctrl-C, or SIGINT, twice ends";
  tell(listener_.note, fmt::format("stops when the frames of this window are made, up to t = {:g}; {} it at once",
                                   engine_.progress().time, how));
}

void SceneRun::take_output_warnings() {
  if (files_ != nullptr) return tell_all(listener_, files_->outputs.take_warnings());
  const std::string warning = measured_ ? measured_->take_warning() : "";
  if (!warning.empty()) tell(listener_.warning, warning);
}

// follow: called before each sample, with its time.
void SceneRun::watch_samples(RunObserver& observer, const std::function<void(double)>& follow) {
  RunningAnalysis* const analysis = this->analysis();
  if (analysis == nullptr) return;
  observer.sample = [this, follow, analysis](const DisksInPieces& disks) {
    follow(disks.time());
    analysis->sample(disks, engine_.progress());
    take_output_warnings();
    say_what_a_stop_waits_for();
  };
  if (!analysis->record().series.time.empty()) observer.last_sample = analysis->last_time();
}

RunObserver SceneRun::observer() {
  RunObserver observer;
  observer.go_on = [this] { return !keeper_.wants_stop(); };
  observer.pulse = [this](double seconds) { return pulse(seconds); };
  if (files_ == nullptr) {
    if (!measured_) return observer;
    watch_samples(observer, [this](double t) { measured_->follow(engine_, t); });
    observer.stepped = [this] { measured_->follow(engine_, engine_.progress().time); };
    return observer;
  }
  RunOutputs& outputs = files_->outputs;
  if (wants_frames(scene_.output)) {
    observer.frame = [this, &outputs](const DisksInPieces& disks) {
      outputs.follow(engine_, disks.time());
      outputs.frame(disks, engine_.progress());
      take_output_warnings();
      say_what_a_stop_waits_for();
    };
    if (goes_on_ && outputs.frames() > 0) observer.last_frame = outputs.last_time();
  }
  watch_samples(observer, [this, &outputs](double t) { outputs.follow(engine_, t); });
  if (outputs.follows()) observer.stepped = [this, &outputs] { outputs.follow(engine_, engine_.progress().time); };
  return observer;
}

void SceneRun::go() {
  tell(listener_.begins, engine_.progress(), disks_);
  try {
    step_s_ = run_to_end(engine_, scene_, observer());
    if (settings_.strict && keeper_.stopped_by().empty()) fail_if_any(energy_gained());
  } catch (const PhysicsError& error) {
    // In the state that is kept they are marked as reported; with --strict the error contains the warning.
    take_news(settings_.strict);
    if (files_ == nullptr) throw;
    keep_stopped(error);
  }
}

// A run that a PhysicsError stopped keeps its files for inspection, in a place where they cannot be taken for a result;
// and as a checkpoint the last good state, or the one in which disks are crushed, which is so only after the step. It
// fails again if it is continued, but may be the end of the run.
void SceneRun::keep_stopped(const PhysicsError& error) {
  std::string last_state;
  try {
    keeper_.write(engine_, step_s_);
    const State& state = engine_.progress();
    const bool crushed = state.validity.crushed.overlap.size > 0.0;
    last_state = fmt::format(", its last {}state in {}", crushed ? "" : "good ", checkpoint_name);
    if (state.time > 0.0) {
      last_state +=
          fmt::format("; {} --t-end {} ends it there, with all results", keeper_.resume_command(), state.time);
    }
  } catch (const RunError& why) {
    last_state = fmt::format("; {}", why.what());
  }
  files_->outputs.finish(RunEnd::early);
  throw PhysicsError(fmt::format("{}; the results up to there are kept in {}{}", error.what(),
                                 files_->folder.keep_unfinished(), last_state));
}

std::vector<std::string> SceneRun::energy_gained() const {
  const Energy now = sums_of(engine_, scene_, settings_.engine).at.energy;
  return energy_warnings(scene_, keeper_.record(step_s_).start, engine_.progress(), now);
}

Summary SceneRun::summary() const {
  const RunRecord record = keeper_.record(step_s_);
  Summary summary = summarize(record.start, engine_, scene_, settings_.engine);
  if (files_ != nullptr) summary.frames = files_->outputs.frames();
  if (const RunningAnalysis* const measured = analysis()) {
    summary.measured = measured_means(measured->record(), scene_);
  }
  summary.step_s = record.step_s;
  summary.wall_s = record.wall_s;
  summary.cpu_s = record.cpu_s;
  summary.resumed = record.resumed;
  summary.warnings = warnings_so_far(record, scene_, engine_.progress());
  return summary;
}

RunOutcome SceneRun::stopped() {
  if (files_ != nullptr) files_->outputs.pause();
  RunOutcome outcome{summary(), files_ != nullptr ? files_->folder.name() : "", keeper_.stopped_by(), ""};
  outcome.summary.resume_with = keeper_.resume_command();
  return outcome;
}

// Keeps the last checkpoint of a run that is done if that is wanted, or needed to draw lost plots. Returns whether
// there is one.
bool SceneRun::keep_last_checkpoint(const OutputMark& mark) {
  const bool wanted = scene_.output.checkpoint > 0.0;
  if (!wanted && files_->outputs.lost_plots().empty()) return false;
  try {
    keeper_.write(engine_, step_s_, mark);
  } catch (const RunError&) {
    if (wanted) throw;
    return false;
  }
  return true;
}

// Makes the page of the run, if it is wanted. Returns why it could not be made; empty if it was.
std::string SceneRun::make_page() {
  if (!scene_.output.view) return "";
  const fs::path page = files_->folder.path("view.html");
  try {
    ViewSettings settings;
    settings.engine = settings_.engine;
    settings.scene = &scene_;
    settings.warn = [this](std::string_view warning) { tell(listener_.warning, warning); };
    const Recording recording{files_->folder.name(), trajectory_in(files_->folder.unfinished()), false};
    for (const std::string& sentence : write_view(page, recording, settings).left_out) {
      tell(listener_.note, fmt::format("view.html {}", sentence));
    }
    return "";
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    fs::remove(page, ignored);
    return fmt::format("view.html could not be made: {}", error.what());
  }
}

RunOutcome SceneRun::finished() {
  bool keeps_checkpoint = false;
  std::string lost_view;
  if (files_ != nullptr) {
    const OutputMark mark = files_->outputs.finish(RunEnd::whole);
    lost_view = make_page();
    keeps_checkpoint = keep_last_checkpoint(mark);
    take_output_warnings();
  }
  for (const std::string& warning : worst_moment_warnings(scene_, engine_.progress())) {
    if (std::find(told_.begin(), told_.end(), warning) == told_.end()) tell(listener_.warning, warning);
  }
  keeper_.discard_own_folder();
  RunOutcome outcome{summary(), "", "", ""};
  std::vector<std::string> at_end = energy_gained();
  for (const auto& more :
       {few_inaccurate_warnings(scene_, engine_.progress()), waiting_warnings(scene_, engine_.progress())}) {
    at_end.insert(at_end.end(), more.begin(), more.end());
  }
  tell_all(listener_, at_end);
  outcome.summary.warnings.insert(outcome.summary.warnings.end(), at_end.begin(), at_end.end());
  if (files_ == nullptr) return outcome;
  write_file(files_->folder.path("summary.json"), json_text(outcome.summary));
  files_->folder.finish(keeps_checkpoint);
  outcome.folder = files_->folder.name();
  outcome.lost_pictures = lost_pictures(scene_, *files_, lost_view, keeps_checkpoint);
  return outcome;
}

}  // namespace carom
