#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/run/run_and_report.hpp"
#include "core/base/check.hpp"
#include "core/base/input_file.hpp"
#include "core/scene/scene_text.hpp"
#include "io/files/output_folder.hpp"
#include "run/loop/stop_signals.hpp"
#include "run/scene/resume_checks.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

Scene scene_of(const RunRecord& record, const SceneChanges& changes) {
  return scene_as_told(changes, [&](const std::vector<Override>& overrides) {
    return parse_scene(record.scene_text, record.scene_file, "", overrides);
  });
}

// Warns that an edited scene.toml will be written anew.
void warn_of_other_scene(const CheckpointPlace& place, const RunRecord& record) {
  const fs::path file = present_path(place.folder, "scene.toml");
  if (!fs::exists(file)) return;
  try {
    const std::string text = read_text_file(file.string(), file.string());
    // Another version may have written the same scene in other words.
    const auto same = [&] { return resolved_toml(parse_scene(text, "", "")) == resolved_toml(scene_of(record, {})); };
    if (text == record.scene_text || same()) return;
  } catch (const InputError&) {
  }
  print_warning(fmt::format("{} has changed: the run continues with the scene in its checkpoint", file.string()));
}

// Sets the folder of the results: -o, or that of the run's files. A checkpoint saved by a program is among the
// program's own files: the results go where those of a new run do.
void take_folder(const ResumeOptions& options, const ResumeFrom& from, const Scene& scene, RunSettings& settings) {
  const bool of_program = is_of_program(from.checkpoint.record);
  if (!options.folder && of_program) {
    take_usual_folder(scene, settings);
    if (settings.folder && !options.quiet) print_note(fmt::format("results go to {}", settings.folder->string()));
    return;
  }
  const fs::path folder = options.folder ? fs::path(*options.folder) : from.place.folder;
  std::error_code error;
  if (of_program || !fs::equivalent(folder, from.place.folder, error)) {
    check_output_folder(folder, from.place.file, options.force);
  }
  settings.folder = folder;
}

}  // namespace

int command_resume(const ResumeOptions& options) {
  RunSettings settings = settings_of(options);
  catch_signals();
  ResumeFrom from{{}, find_checkpoint(options.checkpoint)};
  if (options.lead != nullptr) {
    auto [checkpoint, disks] = read_checkpoint_in_pieces_at(from.place);
    from.checkpoint = std::move(checkpoint);
    from.disks = std::move(disks);
  } else {
    from.checkpoint = read_checkpoint_at(from.place);
  }
  const RunRecord& record = from.checkpoint.record;
  const Scene scene = scene_of(record, options.changes);
  check_view(options, scene);
  check_resumable(from, scene_of(record, {}), scene, options.checkpoint);
  settings.engine =
      choose_engine(options.engine.empty() ? record.engine : options.engine, options.threads, options.lead);
  if (record.version != CAROM_VERSION && !options.quiet) {
    print_warning(fmt::format("{} was written by Carom {}; {} may differ from it in the last bits", options.checkpoint,
                              record.version, CAROM_VERSION));
  }
  if (!options.quiet && !is_of_program(record)) warn_of_other_scene(from.place, record);
  take_folder(options, from, scene, settings);
  return run_and_report(options, scene, std::move(settings), std::move(from), nullptr);
}

}  // namespace carom
