#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "app/cli/commands.hpp"
#include "app/cli/progress.hpp"
#include "app/run/growth_line.hpp"
#include "app/run/run_task.hpp"
#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/load/method_choice.hpp"
#include "core/load/scene_check.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/scene/scene_text.hpp"
#include "core/step/validity.hpp"
#include "io/checkpoint/checkpoint_place.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_file.hpp"
#include "io/files/output_folder.hpp"
#include "run/checkpoint_keeper.hpp"
#include "run/make_engine.hpp"
#include "run/run_loop.hpp"
#include "run/run_outputs.hpp"
#include "run/stop_signals.hpp"
#include "run/strict_engine.hpp"
#include "run/summary.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Where the results go: -o, or out/<name of the scene> if the scene asks for files at all, and the first free of
// out/<name>-2 and so on where that holds a run. Says which.
std::optional<fs::path> folder_of(const RunOptions& options, const Scene& scene) {
  if (options.folder || !wants_files(scene)) {
    if (options.folder) check_output_folder(*options.folder, options.scene, options.force);
    return options.folder ? std::optional<fs::path>(*options.folder) : std::nullopt;
  }
  const fs::path wanted = fs::path("out") / fs::path(options.scene).stem();
  if (options.force) check_output_folder(wanted, options.scene, true);
  const fs::path folder = options.force ? wanted : free_output_folder(wanted, options.scene);
  if (options.quiet) return folder;
  std::string note = fmt::format("results go to {}", folder.string());
  if (folder != wanted) {
    const bool stopped = fs::exists(present_path(wanted, checkpoint_name)) && !fs::exists(wanted / "summary.json");
    note += fmt::format(
        " ({} holds another run; {})", wanted.string(),
        stopped ? fmt::format("carom resume {} goes on with that", wanted.string()) : "--force replaces it");
  }
  print_note(note);
  return folder;
}

// Goes on where the run's files lie, or in another folder with copies of them.
bool goes_elsewhere(const RunTask& task) {
  std::error_code error;
  return !fs::equivalent(*task.folder, task.from->place.folder, error);
}

// Brings the files that the run goes on with into the folder's unfinished part. Returns the folder.
const OutputFolder& with_files(OutputFolder& folder, const RunTask& task) {
  const CheckpointPlace& place = task.from->place;
  std::vector<std::string> files;
  for (const MarkedFile& file : files_of(task.from->checkpoint.record.outputs)) files.push_back(file.name);
  if (goes_elsewhere(task)) {
    for (const std::string& file : files) {
      fs::copy(present_path(place.folder, file), folder.path(file), fs::copy_options::recursive);
    }
    return folder;
  }
  // What comes after the checkpoint that was named is given up, a damaged newer one with it.
  if (place.file.filename() == previous_checkpoint_name) {
    fs::rename(place.file, place.file.parent_path() / checkpoint_name);
  }
  files.insert(files.end(), {previous_checkpoint_name, checkpoint_name});
  folder.take_back(place.finished, files);
  return folder;
}

// The files of a run, if it has any, from the first byte to the finished folder.
struct Results {
  Results(const RunTask& task, const fs::path& path)
      : folder(path, task.scene.file, task.force), outputs(task.scene, folder, make_pair_counter(task.choice)) {
    write_file(folder.path("scene.toml"), resolved_toml(task.scene));
  }
  explicit Results(const RunTask& task)
      : folder(goes_elsewhere(task) ? OutputFolder(*task.folder, task.from->place.file, task.force)
                                    : OutputFolder(*task.folder)),
        outputs(task.scene, with_files(folder, task), make_pair_counter(task.choice),
                task.from->checkpoint.record.outputs) {
    write_file(folder.path("scene.toml"), resolved_toml(task.scene));
  }
  OutputFolder folder;
  RunOutputs outputs;
};

// What the machine did not let happen; how to go on where there is a checkpoint.
[[noreturn]] void fail_resumable(const std::string& what, const CheckpointKeeper& keeper) {
  const std::string command = keeper.resume_command();
  throw RunError(command.empty() ? what : fmt::format("{}; the last checkpoint is whole: {}", what, command));
}

void warn(const std::vector<std::string>& warnings, Progress& progress, bool quiet) {
  if (warnings.empty() || quiet) return;
  progress.clear();
  for (const std::string& warning : warnings) print_warning(warning);
}

// A run that a PhysicsError stopped keeps what it has written, for inspection, in a place where it cannot be taken for
// a result; and the last good state as a checkpoint.
[[noreturn]] void keep_stopped(const PhysicsError& error, const State& state, Results& results,
                               CheckpointKeeper& keeper, double step_s) {
  std::string last_state;
  try {
    keeper.write(state, step_s);
    last_state = fmt::format(", its last good state in {}", checkpoint_name);
  } catch (const RunError& why) {
    last_state = fmt::format("; {}", why.what());
  }
  results.outputs.finish(false);
  throw PhysicsError(fmt::format("{}; the run up to there is kept in {}{}", error.what(),
                                 results.folder.keep_unfinished(), last_state));
}

// Steps to the end with all outputs, progress and checkpoints, or until the keeper says stop; returns the seconds in
// steps. told: the warnings that the engine has raised, printed or not.
double run_watched(Engine& engine, const RunTask& task, Results* results, CheckpointKeeper& keeper,
                   std::vector<std::string>& told) {
  const Scene& scene = task.scene;
  Progress progress(!task.quiet, scene.run.t_end, engine.state());
  RunObserver observer;
  double step_s = 0.0;
  const auto take_news = [&](bool silent) {
    const std::vector<std::string> news = engine.take_warnings();
    warn(news, progress, silent);
    told.insert(told.end(), news.begin(), news.end());
  };
  observer.go_on = [&] { return !keeper.wants_stop(); };
  observer.pulse = [&](double seconds) {
    step_s = seconds;
    take_news(task.quiet);
    progress.update(engine.state());
    const bool go_on = keeper.look(engine.state(), scene.run.t_end, seconds);
    const std::string note = keeper.take_note();
    if (!note.empty() && !task.quiet) {
      progress.clear();
      print_note(note);
    }
    return go_on;
  };
  RunningAnalysis* const analysis = results != nullptr ? results->outputs.analysis() : nullptr;
  if (results != nullptr && wants_frames(scene.output)) {
    observer.frame = [&](const Disks& disks, double time) {
      results->outputs.follow(engine, time);
      results->outputs.frame(disks, time, engine.state());
      warn(results->outputs.take_warnings(), progress, task.quiet);
    };
    if (task.from && results->outputs.frames() > 0) observer.last_frame = results->outputs.last_time();
  }
  if (analysis != nullptr) {
    observer.sample = [&](const Disks& disks, double time) {
      results->outputs.follow(engine, time);
      analysis->sample(disks, time, engine.state());
      warn(results->outputs.take_warnings(), progress, task.quiet);
    };
    if (!analysis->record().series.time.empty()) observer.last_sample = analysis->last_time();
  }
  if (results != nullptr && results->outputs.follows()) {
    observer.stepped = [&] { results->outputs.follow(engine, engine.state().time); };
  }
  try {
    step_s = run_to_end(engine, scene, observer);
    if (task.strict && keeper.stopped_by().empty()) {
      fail_if_any(energy_warnings(scene, keeper.record(step_s).start, engine.state()));
    }
    return step_s;
  } catch (const PhysicsError& error) {
    // The state that is kept has them marked as told; with --strict the error has the warning.
    take_news(task.quiet || task.strict);
    if (results == nullptr) throw;
    keep_stopped(error, engine.state(), *results, keeper, step_s);
  }
}

// What the run warns of when it has come to this state: of its start, and the worst of what was seen.
std::vector<std::string> warnings_so_far(const RunRecord& record, const Scene& scene, const State& state) {
  std::vector<std::string> warnings = record.warnings;
  for (std::string& warning : validity_so_far(scene, state)) warnings.push_back(std::move(warning));
  return warnings;
}

Summary summary_of(const Engine& engine, const RunTask& task, const Results* results, const RunRecord& record) {
  Summary summary = summarize(record.start, engine, task.scene, task.choice);
  summary.frames = results != nullptr ? results->outputs.frames() : 0;
  summary.step_s = record.step_s;
  summary.wall_s = record.wall_s;
  summary.cpu_s = record.cpu_s;
  summary.resumed = record.resumed;
  summary.warnings = warnings_so_far(record, task.scene, engine.state());
  return summary;
}

int report_stop(const Engine& engine, const RunTask& task, Results* results, const CheckpointKeeper& keeper,
                double step_s) {
  if (results != nullptr) results->outputs.pause();
  print_note(fmt::format("stopped by {} at t = {:g} of {:g}; go on with {}", keeper.stopped_by(), engine.state().time,
                         task.scene.run.t_end, keeper.resume_command()));
  if (task.json) {
    Summary summary = summary_of(engine, task, results, keeper.record(step_s));
    summary.resume_with = keeper.resume_command();
    print_out(json_text(summary));
  }
  return 4;
}

// Pictures that could not be made, on one line, and how to make them.
std::string lost_pictures(const RunTask& task, const Results& results, bool resumable) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const std::string& plot : results.outputs.lost_plots()) add(plot);
  const std::string& folder = results.folder.name();
  const std::string& movie = results.outputs.lost_movie();
  if (!movie.empty()) add(movie);
  if (text.empty()) return text;
  add(fmt::format("all else of the run is in {}", folder));
  if (resumable && !results.outputs.lost_plots().empty()) add(fmt::format("carom resume {} draws the plots", folder));
  if (!movie.empty() && task.scene.output.trajectory != TrajectoryFormat::none) {
    add(fmt::format("carom render {} makes the movie", folder));
  }
  return text;
}

// The last checkpoint of a run that is done: asked for, or needed to draw lost plots from. Is there one?
bool keep_last_checkpoint(const Engine& engine, const RunTask& task, const Results& results, CheckpointKeeper& keeper,
                          double step_s, const OutputMark& mark) {
  const bool wanted = task.scene.output.checkpoint > 0.0;
  if (!wanted && results.outputs.lost_plots().empty()) return false;
  try {
    keeper.write(engine.state(), step_s, mark);
  } catch (const RunError&) {
    if (wanted) throw;
    return false;
  }
  return true;
}

// Completes the files and reports. Returns the exit status.
int report_end(const Engine& engine, const RunTask& task, Results* results, CheckpointKeeper& keeper, double step_s,
               const std::vector<std::string>& told) {
  bool keeps_checkpoint = false;
  if (results != nullptr) {
    const OutputMark mark = results->outputs.finish(true);
    keeps_checkpoint = keep_last_checkpoint(engine, task, *results, keeper, step_s, mark);
    if (!task.quiet) {
      for (const std::string& warning : results->outputs.take_warnings()) print_warning(warning);
    }
  }
  if (!task.quiet) {
    for (const std::string& warning : worst_moments(task.scene, engine.state())) {
      if (std::find(told.begin(), told.end(), warning) == told.end()) print_warning(warning);
    }
  }
  keeper.discard_own_folder();
  Summary summary = summary_of(engine, task, results, keeper.record(step_s));
  std::vector<std::string> at_end = energy_warnings(task.scene, keeper.record(step_s).start, engine.state());
  for (const std::string& warning : waiting_warnings(task.scene, engine.state())) at_end.push_back(warning);
  for (const std::string& warning : at_end) {
    summary.warnings.push_back(warning);
    if (!task.quiet) print_warning(warning);
  }
  if (results != nullptr) {
    write_file(results->folder.path("summary.json"), json_text(summary));
    results->folder.finish(keeps_checkpoint);
  }
  if (task.json) {
    print_out(json_text(summary));
  } else if (!task.quiet) {
    print_out(table_text(summary, results != nullptr ? results->folder.name() : ""));
  }
  const std::string lost = results != nullptr ? lost_pictures(task, *results, keeps_checkpoint) : "";
  if (lost.empty()) return 0;
  print_note(fmt::format("error: {}", lost));
  return 1;
}

// The record of a run that begins, or of one that goes on.
RunRecord record_of(RunTask& task, const Engine& engine) {
  RunRecord record;
  if (task.from) {
    record = task.from->checkpoint.record;
    ++record.resumed;
  } else {
    record.start = run_start(engine.state(), task.scene);
    record.scene_file = task.scene.file;
  }
  record.version = CAROM_VERSION;
  record.scene_text = resolved_toml(task.scene);
  record.engine = task.choice.name;
  return record;
}

State state_of(RunTask& task) {
  return task.from ? std::move(task.from->checkpoint.state)
                   : make_initial_state(task.choice, task.scene, growth_line(!task.quiet));
}

}  // namespace

int carry_out(RunTask task) {
  const Scene& scene = task.scene;
  auto engine = within_memory(scene, [&] { return make_engine(task.choice, scene, state_of(task)); });
  const std::vector<std::string> warnings =
      validity_of(scene, smallest_radius(engine->state().disks), fastest_speed(engine->state().disks));
  if (task.strict) {
    fail_if_any(warnings);
    if (task.from) fail_if_any(warnings_so_far(task.from->checkpoint.record, scene, engine->state()));
    engine = make_strict(std::move(engine));
  }
  for (const std::string& warning : warnings) {
    if (!task.quiet) print_warning(warning);
  }
  task.setup = nullptr;
  RunRecord record = record_of(task, *engine);
  if (!task.from) record.warnings = warnings;
  const bool new_plan = task.from && record.scene_text != task.from->checkpoint.record.scene_text;
  CheckpointKeeper keeper(record, task.start_time, scene.output.checkpoint, task.max_walltime);
  try {
    std::optional<Results> results;
    if (task.folder && task.from) results.emplace(task);
    if (task.folder && !task.from) results.emplace(task, *task.folder);
    Results* const files = results ? &*results : nullptr;
    if (files != nullptr) files->outputs.share_work(make_block_runner(task.choice));
    const bool there = task.from && !goes_elsewhere(task);
    if (files != nullptr) keeper.write_to(&files->folder, &files->outputs, there);
    // So that a run that is killed in its first minutes is not lost, nor the options with which it was resumed.
    if (new_plan || (!there && (task.from || scene.output.checkpoint > 0.0))) keeper.write(engine->state(), 0.0);
    std::vector<std::string> told;
    const double step_s = run_watched(*engine, task, files, keeper, told);
    if (!keeper.stopped_by().empty()) return report_stop(*engine, task, files, keeper, step_s);
    return report_end(*engine, task, files, keeper, step_s, told);
  } catch (const RunError& error) {
    fail_resumable(error.what(), keeper);
  } catch (const std::bad_alloc&) {
    fail_resumable("out of memory", keeper);
  }
}

int command_run(const RunOptions& options) {
  const auto start_time = std::chrono::steady_clock::now();
  catch_signals();
  const auto watch = [&] { return std::make_unique<SetupWatch>(start_time, options.max_walltime); };
  auto setup = watch();
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  setup = nullptr;  // looking for a folder makes some
  const EngineChoice choice = choose_engine(options.engine, options.threads);
  if (!options.quiet) {
    for (const std::string& warning : scene_warnings(scene)) print_warning(warning);
    if (scene.run.automatic) print_note(choice_text(scene));
  }
  const std::optional<fs::path> path = folder_of(options, scene);
  return carry_out({start_time, scene, choice, path, std::nullopt, options.max_walltime, options.json, options.quiet,
                    options.force, options.strict, watch()});
}

}  // namespace carom
