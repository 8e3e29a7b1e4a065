#include "run/scene/resume_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/input_message.hpp"
#include "core/scene/drawn_velocities.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/step_clock.hpp"
#include "io/files/output_file.hpp"
#include "io/files/output_folder.hpp"
#include "io/files/shell_word.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Checked before anything is changed: do all files exist?
void check_files(const CheckpointPlace& place, const OutputMark& mark) {
  if (place.finished && fs::exists(place.folder / unfinished_name) && fs::exists(place.folder / "summary.json")) {
    fail_input(place.folder.string(), "holds a finished run, and another that stopped before its first checkpoint",
               fmt::format("expected {} to be moved away", (place.folder / unfinished_name).string()));
  }
  for (const MarkedFile& file : files_of(mark))
    check_at_least(present_path(place.folder, file.name).string(), file.bytes);
}

// The steps (pairwise), or Brownian intervals, that the state has begun; the clock must still give the same number.
Count begun_steps(const Scene& scene, const State& state) {
  if (scene.run.method == Method::pairwise) return state.counters.steps;
  return scene.physics.diffusion > 0.0 ? state.intervals : 0;
}

// The file of the run's scene with the changes by options and --set; otherwise the file that it came from.
std::string scene_file_of(const CheckpointPlace& place, const Scene& scene) {
  const fs::path kept = present_path(place.folder, "scene.toml");
  return fs::exists(kept) ? kept.string() : scene.file;
}

// May the run end at another time than the first one given? It must not have to go back, and a step that was cut short
// to end at the old time must not have begun.
void check_end(const CheckpointPlace& place, const Scene& before, const Scene& now, const State& state) {
  const double t_end = now.run.t_end;
  if (t_end == before.run.t_end) return;
  const std::string told = fmt::format("is {}", t_end);
  if (t_end < state.time)
    fail_input("--t-end", told, fmt::format("expected at least {}, the time of the checkpoint", state.time));
  const Count begun = begun_steps(before, state);
  if (begun == 0 || t_end == state.time) return;
  const StepClock old_clock = make_step_clock(before.run.dt, before.run.t_end);
  const StepClock new_clock = make_step_clock(now.run.dt, t_end);
  if (new_clock.steps < begun || (now.run.method == Method::pairwise && new_clock.steps == begun)) {
    fail_input("--t-end", told, fmt::format("expected at least a step of {} after {}", now.run.dt, state.time));
  }
  if (old_clock.length(begun - 1) == new_clock.length(begun - 1)) return;
  fail_input(
      "--t-end", fmt::format("{}, but the last step of the run was shortened to end at {}", told, before.run.t_end),
      fmt::format("expected an earlier checkpoint, or a new run to the later end: carom run {} --t-end {} -o DIR",
                  shell_word(scene_file_of(place, now)), t_end));
}

// Was a plot lost at the end of the run, or removed since? Continuing the run from its end draws it.
bool lacks_plots(const Scene& scene, const fs::path& folder) {
  const auto lacks = [&](std::string_view name) { return !fs::exists(folder / fmt::format("{}.svg", name)); };
  for (std::size_t k = 0; k < quantity_names.size(); ++k) {
    if (scene.analysis.wanted[k] && lacks(quantity_names[k])) return true;
  }
  return std::any_of(scene.output.plots.begin(), scene.output.plots.end(), [&](const std::string& plot) {
    return lacks(plot) && !(plot == "energy" && velocities_are_drawn(scene));
  });
}

}  // namespace

void check_resumable(const ResumeFrom& from, const Scene& before, const Scene& now, const std::string& name) {
  const Checkpoint& checkpoint = from.checkpoint;
  const CheckpointPlace& place = from.place;
  if (checkpoint.state.sources.size() != now.sources.size()) {
    fail_input(name, "holds a state that does not belong to its scene",
               "expected a checkpoint as Carom wrote it; try the earlier one, checkpoint.previous.carom");
  }
  check_end(place, before, now, checkpoint.state);
  check_files(place, checkpoint.record.outputs);
  if (place.finished && checkpoint.state.time >= now.run.t_end && fs::exists(place.folder / "summary.json") &&
      !lacks_plots(now, place.folder)) {
    fail_input(name, fmt::format("the run is finished: it ended at t = {}", checkpoint.state.time),
               fmt::format("expected a later --t-end, as in carom resume {} --t-end {}", shell_word(name),
                           2.0 * checkpoint.state.time));
  }
}

}  // namespace carom
