#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <optional>

#include "app/commands.hpp"
#include "app/make_engine.hpp"
#include "app/progress.hpp"
#include "app/run_loop.hpp"
#include "app/run_outputs.hpp"
#include "app/summary.hpp"
#include "core/check.hpp"
#include "core/initial_state.hpp"
#include "core/input_message.hpp"
#include "core/method_choice.hpp"
#include "core/scene_check.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Of all threads of this process. A month of 64 threads still fits.
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Where the results go: -o, or out/<name of the scene> if the scene asks for files at all.
std::optional<fs::path> folder_of(const RunOptions& options, const Scene& scene) {
  if (options.folder) return *options.folder;
  if (!wants_frames(scene.output)) return std::nullopt;
  return fs::path("out") / fs::path(options.scene).stem();
}

void check_outputs(const Scene& scene) {
  if (scene.output.trajectory == TrajectoryFormat::h5md) {
    fail_input(fmt::format("{}: output.trajectory", scene.file), "h5md is not built yet", "expected xyz or none");
  }
}

// The files of a run, if it has any, from the first byte to the finished folder.
struct Results {
  Results(const Scene& scene, const fs::path& path, bool force)
      : folder(path, scene.file, force), outputs(scene, folder) {
    write_file(folder.path("scene.toml"), resolved_toml(scene));
  }
  OutputFolder folder;
  RunOutputs outputs;
};

void warn(const std::vector<std::string>& warnings, Progress& progress, bool quiet) {
  if (warnings.empty() || quiet) return;
  progress.clear();
  for (const std::string& warning : warnings) print_warning(warning);
}

// Steps to the end with everybody watching; returns the seconds in steps. A run that the physics stopped keeps what it
// has written, as somebody will want to see what happened, but nowhere that it could be taken for a result.
double run_watched(Engine& engine, const Scene& scene, Results* results, bool quiet) {
  Progress progress(!quiet, scene.run.t_end);
  RunObserver observer;
  observer.pulse = [&] {
    warn(engine.take_warnings(), progress, quiet);
    progress.update(engine.state());
  };
  if (results != nullptr && wants_frames(scene.output)) {
    observer.frame = [&](const Disks& disks, double time) {
      results->outputs.frame(disks, time, engine.state());
      warn(results->outputs.take_warnings(), progress, quiet);
    };
  }
  try {
    return run_to_end(engine, scene, observer);
  } catch (const PhysicsError& error) {
    if (results == nullptr) throw;
    results->outputs.finish(false);
    throw PhysicsError(
        fmt::format("{}; the run up to there is kept in {}", error.what(), results->folder.keep_unfinished()));
  }
}

}  // namespace

int command_run(const RunOptions& options) {
  const auto start_time = Clock::now();
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  const EngineChoice choice = choose_engine(options.engine, options.threads);
  check_outputs(scene);
  if (!options.quiet) {
    for (const std::string& warning : scene_warnings(scene)) print_warning(warning);
    if (scene.run.automatic) print_note(choice_text(scene));
  }
  const std::optional<fs::path> path = folder_of(options, scene);
  if (path) check_output_folder(*path, options.scene, options.force);
  if (path && !options.folder && !options.quiet) print_note(fmt::format("results go to {}", path->string()));

  const auto engine = within_memory(scene, [&] { return make_engine(choice, scene, initial_state(scene)); });
  const RunStart start = run_start(engine->state(), scene);
  std::optional<Results> results;
  if (path) results.emplace(scene, *path, options.force);
  const double step_seconds = run_watched(*engine, scene, results ? &*results : nullptr, options.quiet);

  if (results) {
    results->outputs.finish(true);
    if (!options.quiet) {
      for (const std::string& warning : results->outputs.take_warnings()) print_warning(warning);
    }
  }
  Summary summary = summarize(start, *engine, scene, choice);
  summary.frames = results ? results->outputs.frames() : 0;
  summary.step_s = step_seconds;
  summary.wall_s = seconds_since(start_time);
  summary.cpu_s = cpu_seconds();
  if (results) {
    write_file(results->folder.path("summary.json"), json_text(summary));
    results->folder.finish();
  }
  if (options.json) {
    print_out(json_text(summary));
  } else if (!options.quiet) {
    print_out(table_text(summary, path ? path->string() : ""));
  }
  return 0;
}

}  // namespace carom
