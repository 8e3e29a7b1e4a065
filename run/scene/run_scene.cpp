#include "run/scene/run_scene.hpp"

#include <fmt/format.h>

#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/float_environment.hpp"
#include "core/scene/scene_text.hpp"
#include "core/step/validity.hpp"
#include "run/engine/strict_engine.hpp"
#include "run/loop/checkpoint_keeper.hpp"
#include "run/outputs/run_outputs.hpp"
#include "run/scene/run_files.hpp"
#include "run/scene/scene_run.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Throws for what the machine prevented, with the command that continues the run if there is a checkpoint.
[[noreturn]] void fail_resumable(const std::string& what, const CheckpointKeeper& keeper) {
  const std::string command = keeper.resume_command();
  throw RunError(command.empty() ? what : fmt::format("{}; the last checkpoint is intact: {}", what, command));
}

// The record of a run that begins, or of one that is continued.
RunRecord record_of(const Scene& scene, const ResumeFrom* from, const RunSettings& settings, const RunStart& start) {
  RunRecord record;
  if (from != nullptr) {
    record = from->checkpoint.record;
    ++record.resumed;
  } else {
    record.start = start;
    record.scene_file = scene.file;
  }
  record.version = CAROM_VERSION;
  record.scene_text = resolved_toml(scene);
  record.engine = settings.engine.name;
  return record;
}

std::unique_ptr<Engine> engine_of(const Scene& scene, ResumeFrom* from, RunSettings& settings) {
  if (from != nullptr && from->disks) {
    return make_engine(settings.engine, scene, std::move(from->checkpoint.state), std::move(from->disks));
  }
  if (from != nullptr) return make_engine(settings.engine, scene, std::move(from->checkpoint.state));
  // Its line of progress ends with it.
  const auto watch = std::exchange(settings.listener.growth, {});
  return make_engine_at_start(settings.engine, scene, watch);
}

// The folder was named before the initial state was made.
void tell_if_elsewhere(const RunSettings& settings, const std::string& name) {
  if (name == settings.folder->string()) return;
  tell(settings.listener.note,
       fmt::format("another run has taken {} meanwhile: results go to {}", settings.folder->string(), name));
}

// The engine at the run's start.
struct StartedEngine {
  std::unique_ptr<Engine> engine;
  RunStart at;
  std::vector<std::string> warnings;  // of the initial state
};
StartedEngine start_engine(const Scene& scene, ResumeFrom* from, RunSettings& settings) {
  StartedEngine start;
  start.engine = within_memory(scene, [&] { return engine_of(scene, from, settings); });
  const StateSums sums = sums_of(*start.engine, scene, settings.engine);
  start.at = sums.at;
  start.warnings = validity_warnings_at_start(scene, sums.smallest_radius, sums.fastest);
  if (!settings.strict) return start;
  fail_if_any(start.warnings);
  if (from != nullptr) fail_if_any(warnings_so_far(from->checkpoint.record, scene, start.engine->progress()));
  start.engine = make_strict(std::move(start.engine));
  return start;
}

RunOutcome carry_out(const Scene& scene, ResumeFrom* from, RunSettings settings) {
  const FloatEnvironment environment;
  const auto [engine, at, warnings] = start_engine(scene, from, settings);
  tell_all(settings.listener, warnings);
  tell(settings.listener.ready);
  RunRecord record = record_of(scene, from, settings, at);
  if (from == nullptr) record.warnings = warnings;
  const bool new_plan = from != nullptr && record.scene_text != from->checkpoint.record.scene_text;
  const double interval = settings.folder ? scene.output.checkpoint : 0.0;
  CheckpointKeeper keeper(record, settings.start_time, interval, settings.max_walltime);
  try {
    std::optional<RunFiles> results;
    if (settings.folder && from != nullptr) {
      results.emplace(scene, settings, *settings.folder, *from, engine->progress().next_id);
    }
    if (settings.folder && from == nullptr) results.emplace(scene, settings, *settings.folder);
    RunFiles* const files = results ? &*results : nullptr;
    if (files != nullptr && settings.usual) tell_if_elsewhere(settings, files->folder.name());
    const bool there = from != nullptr && settings.folder && !goes_elsewhere(*from, *settings.folder);
    if (files != nullptr) keeper.write_to(&files->folder, &files->outputs, there);
    // So neither a run that is killed in its first minutes is lost, nor the options with which it was resumed.
    const bool wanted = from != nullptr || scene.output.checkpoint > 0.0;
    if (files != nullptr && (new_plan || (!there && wanted))) keeper.write(*engine, 0.0);
    SceneRun scene_run(scene, settings, *engine, files, keeper, from != nullptr, at.particles);
    scene_run.go();
    return keeper.stopped_by().empty() ? scene_run.finished() : scene_run.stopped();
  } catch (const RunError& error) {
    fail_resumable(error.what(), keeper);
  } catch (const std::bad_alloc&) {
    fail_resumable("out of memory", keeper);
  }
}

}  // namespace

RunOutcome run(const Scene& scene, RunSettings settings) {
  return carry_out(scene, nullptr, std::move(settings));
}

RunOutcome resume(const Scene& scene, ResumeFrom from, RunSettings settings) {
  return carry_out(scene, &from, std::move(settings));
}

void take_usual_folder(const Scene& scene, RunSettings& settings) {
  if (!wants_files(scene)) return;
  if (settings.force) {
    settings.folder = usual_folder_name(scene.file);
    check_output_folder(*settings.folder, scene.file, true);
    return;
  }
  settings.usual = usual_output_folder(scene.file);
  settings.folder = settings.usual->first_free;
}

}  // namespace carom
