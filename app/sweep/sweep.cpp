#include "app/sweep/sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>
#include <thread>
#include <utility>

#include "app/cli/messages.hpp"
#include "app/sweep/run_programs.hpp"
#include "app/sweep/scene_of_run.hpp"
#include "app/sweep/sweep_progress.hpp"
#include "app/sweep/sweep_table.hpp"
#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/base/input_message.hpp"
#include "core/scene/scene_text.hpp"
#include "io/files/output_file.hpp"
#include "io/files/shell_word.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* changed = "the scene, or a file that it reads, has changed since the sweep began";

std::string own_path() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  if (error) throw RunError("cannot find this program's own file: " + error.message());
  return path.string();
}

fs::path folder_for(const SweepOptions& options) {
  return options.folder ? fs::path(*options.folder) : fs::path("out") / (fs::path(options.scene).stem() += "_sweep");
}

}  // namespace

Sweep::Sweep(const SweepOptions& options) : options_(options), folder_(folder_for(options)) {
  for (const std::string& text : options.over) add_axis(parse_sweep_axis(text));
  check_other_processes_have(options.scene);
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  runs_ = sweep_runs(options.changes, axes_, scene.seed, options.seeds);
  for (SweepRun& run : runs_) run.scene = fingerprint(resolved_toml(scene_of(run)));
}

void Sweep::add_axis(const SweepAxis& axis) {
  if (std::any_of(axes_.begin(), axes_.end(), [&](const SweepAxis& other) { return other.key == axis.key; })) {
    fail_input("--over", fmt::format("{} is given twice", axis.key), "expected all its values in one --over");
  }
  axes_.push_back(axis);
}

// The scene with which a run would begin now. The run gets the keys of the sweep by --set, but the user gave them by
// --over, so messages name that.
Scene Sweep::scene_of(const SweepRun& run) const {
  try {
    return load_scene_as_told(options_.scene, {run.overrides, run.overrides.size()});
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const SweepAxis& axis : axes_) {
      const std::string told = "--set " + axis.key;
      if (message.starts_with(told)) throw InputError("--over " + message.substr(std::string("--set ").size()));
    }
    throw;
  }
}

void Sweep::open_folder() {
  const std::string scene_text = read_text_file(options_.scene, options_.scene);
  std::error_code error;
  if (fs::is_directory(folder_, error)) {
    lock_.emplace(folder_);
    if (access(folder_.c_str(), W_OK) != 0) {
      fail_input(folder_.string(), fmt::format("cannot be written to: {}", std::strerror(errno)),
                 "expected a folder for the sweep (-o)");
    }
  } else if (fs::exists(folder_, error)) {
    fail_input(folder_.string(), "is a file", "expected a folder for the sweep (-o)");
  }
  if (fs::exists(plan_file(), error)) {
    const Complaint against = go_on(scene_text);
    if (against.what.empty()) return;
    if (!options_.force) {
      fail_input(folder_.string(), fmt::format("holds another sweep: {}", against.what),
                 against.remedy + ", choose another folder with -o, or replace it with --force");
    }
    fs::remove_all(folder_ / "runs", error);
    fs::remove(folder_ / "sweep.csv", error);
  } else if (fs::exists(folder_, error) && !fs::is_empty(folder_, error)) {
    fail_input(folder_.string(), "holds other files", "expected a new folder for the sweep (-o)");
  }
  begin(scene_text);
}

// Continues the sweep in the folder, if it is this one or a part of it. Returns why it is not; empty if it is.
Sweep::Complaint Sweep::go_on(const std::string& scene_text) {
  const std::string plan = plan_file().string();
  std::vector<SweepRun> runs = runs_;
  const std::string before = read_text_file(plan, plan);
  Complaint against{take_names(before, scene_text, runs), "give all its values and more"};
  if (against.what.empty()) against = against_runs(runs);
  if (!against.what.empty()) return against;
  runs_ = std::move(runs);
  const std::string identity = sweep_identity(scene_text, runs_);
  if (identity != before) replace_file(plan, identity);
  return {};
}

// The complaint about the first of these runs that has changed; empty if there is none.
Sweep::Complaint Sweep::against_runs(const std::vector<SweepRun>& runs) const {
  for (const SweepRun& run : runs) {
    const std::string what = against(run);
    if (!what.empty()) return {what, to_run_again(run)};
  }
  return {};
}

// The difference between an existing run and the one that the sweep would run; empty if they agree, or if there is
// none.
std::string Sweep::against(const SweepRun& run) const {
  try {
    const std::string then = scene_of_run(folder_of(run));
    return then.empty() || is_of_fingerprint(then, run.scene) ? "" : change_since(then, scene_of(run), run.name);
  } catch (const InputError& error) {
    return fmt::format("the scene of its run {} is unknown: {}", run.name, error.what());
  }
}

// Prepares the folder before any run.
void Sweep::begin(const std::string& scene_text) {
  const auto make = [](const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail_input(folder.string(), "cannot be made: " + error.message(), "expected a folder (-o)");
  };
  make(folder_);
  if (!lock_) lock_.emplace(folder_);
  // Written completely or not at all: with an incomplete plan a folder with runs would be another sweep's.
  replace_file(plan_file().string(), sweep_identity(scene_text, runs_));
  make(folder_ / "runs");
}

bool Sweep::finished(const SweepRun& run) const {
  return fs::exists(folder_of(run) / "summary.json");
}

std::size_t Sweep::finished() const {
  return static_cast<std::size_t>(
      std::count_if(runs_.begin(), runs_.end(), [&](const SweepRun& r) { return finished(r); }));
}

// Was the run stopped, leaving a checkpoint from which it can continue?
bool Sweep::resumable(const SweepRun& run) const {
  return !finished(run) && !scene_of_run(folder_of(run)).empty();
}

// The scene may be edited, and files that it reads may be written anew, while the sweep runs.
bool Sweep::is_as_planned(const SweepRun& run) const {
  try {
    return resumable(run) || fingerprint(resolved_toml(scene_of(run))) == run.scene;
  } catch (const InputError&) {
    return false;
  }
}

std::string Sweep::to_run_again(const SweepRun& run) const {
  return fmt::format("remove {} to run it again", folder_of(run).string());
}

std::string Sweep::log_of(const SweepRun& run) const {
  return fs::absolute(folder_ / "runs" / (run.name + ".log")).string();
}

// threads: 0 leaves the number to the run.
std::vector<std::string> Sweep::command_of(const SweepRun& run, int threads, const std::string& program) const {
  const std::string folder = fs::absolute(folder_of(run)).string();
  const bool resumes = resumable(run);
  std::vector<std::string> words{program, "resume", folder, "--quiet"};
  if (!resumes) words = {program, "run", fs::absolute(options_.scene).string(), "--quiet", "--force", "-o", folder};
  if (options_.ranks > 1) words.insert(words.end(), {"--ranks", fmt::format("{}", options_.ranks)});
  if (threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", threads)});
  if (resumes) return words;
  for (const Override& change : run.overrides) {
    words.emplace_back("--set");
    words.push_back(fmt::format("{}={}", change.key, change.value));
  }
  return words;
}

std::string Sweep::shell_line(const SweepRun& run, bool over_mpi) const {
  std::string line;
  for (const std::string& word : command_of(run, 0, own_path() + (over_mpi ? "-mpi" : ""))) {
    line += (line.empty() ? "" : " ") + quoted_for_shell(word);
  }
  return line;
}

// Throws RunError if the run cannot be started, or would not be that of the sweep.
std::unique_ptr<ChildProcess> Sweep::start(const SweepRun& run, int threads) const {
  if (!is_as_planned(run)) throw RunError(changed);
  auto process = std::make_unique<ChildProcess>(command_of(run, threads, own_path()), fs::current_path().string(),
                                                log_of(run), ChildSignals::reach_it);
  process->close_input();
  return process;
}

// The last message of a run that failed.
std::string Sweep::last_words(const SweepRun& run, int status) const {
  constexpr std::string_view by_a_run = "carom: error: ";
  const std::string words = last_line(log_of(run));
  if (words.starts_with(by_a_run)) return words.substr(by_a_run.size());
  return words.empty() ? fmt::format("ended with status {}", status) : words;
}

// Removes what is not to be kept of a run that has ended. Returns why it failed; empty if it did not, or if the sweep
// stopped it.
std::string Sweep::close(const SweepRun& run, int status) const {
  constexpr int stopped_early = 4;
  const bool stopped = status == stopped_early || status == 128 + SIGTERM;  // the latter if it had not quite begun
  if (stopped) return stop_wished() ? "" : "was stopped from outside; the same command continues it";
  if (status != 0) return last_words(run, status);
  fs::remove(log_of(run));
  if (against(run).empty()) return "";
  std::error_code ignored;
  fs::remove_all(folder_of(run), ignored);  // it does not belong to this sweep
  return changed;
}

SweepCount Sweep::run_all() const {
  std::vector<const SweepRun*> rest;
  for (const SweepRun& run : runs_) {
    if (!finished(run)) rest.push_back(&run);
    if (finished(run)) fs::remove(log_of(run));  // left if the sweep was killed, and its run came to its end
  }
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int jobs = options_.jobs.value_or(std::max(1, cores / options_.ranks));
  const int threads = std::max(1, cores / jobs / options_.ranks);
  print_note(fmt::format("{} of {} runs are left, {} at once", rest.size(), runs_.size(), jobs));
  catch_signals();
  SweepCount count;
  SweepProgress progress(rest.size());
  const auto fail = [&](const SweepRun& run, const std::string& words) {
    progress.clear();
    print_warning(fmt::format("run {}: {}", run.name, words));
    ++count.failed;
  };
  Programs programs{rest.size(), static_cast<std::size_t>(jobs), {}, {}, {}};
  programs.start = [&](std::size_t k) -> std::unique_ptr<ChildProcess> {
    try {
      return start(*rest[k], threads);
    } catch (const RunError& error) {
      fail(*rest[k], error.what());
      return nullptr;
    }
  };
  programs.ended = [&](std::size_t k, int status) {
    const std::string why = close(*rest[k], status);
    if (!why.empty()) fail(*rest[k], why);
  };
  programs.pulse = [&](std::size_t ended) { progress.update(ended, count.failed); };
  count.stopped = !run_programs(programs);
  progress.clear();
  return count;
}

Json Sweep::summary_of(const SweepRun& run) const {
  std::ifstream file(folder_of(run) / "summary.json");
  Json summary = Json::parse(file, nullptr, false);
  if (!summary.is_object()) {
    fail_input((folder_of(run) / "summary.json").string(), "is not a JSON object",
               fmt::format("expected the summary of a run; {}", to_run_again(run)));
  }
  return summary;
}

SweepTableCount Sweep::write_table() const {
  SweepTableCount count;
  std::vector<SweepRow> rows;
  for (const SweepRun& run : runs_) {
    if (!finished(run)) continue;
    const Json& summary = rows.emplace_back(SweepRow{&run, summary_of(run)}).summary;
    if (!summary.value("warnings", Json()).empty()) ++count.warned;
    count.versions.insert(summary.value("version", Json()).dump());
  }
  replace_file(folder_ / "sweep.csv", sweep_table(axes_, rows));
  return count;
}

}  // namespace carom
