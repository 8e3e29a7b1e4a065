#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/cli/commands.hpp"
#include "app/run/run_and_report.hpp"
#include "io/files/output_folder.hpp"
#include "run/resume_checks.hpp"
#include "run/stop_signals.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

Scene scene_of(const RunRecord& record, const SceneChanges& changes) {
  return scene_as_told(changes, [&](const std::vector<Override>& overrides) {
    return parse_scene(record.scene_text, record.scene_file, "", overrides);
  });
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
  const fs::path folder = options.folder ? fs::path(*options.folder) : from.place.folder;
  std::error_code error;
  if (!fs::equivalent(folder, from.place.folder, error)) {
    check_output_folder(folder, from.place.file, options.force);
  }
  settings.folder = folder;
  return run_and_report(options, scene, std::move(settings), std::move(from), nullptr);
}

}  // namespace carom
