#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/run/run_and_report.hpp"
#include "core/load/method_choice.hpp"
#include "core/load/scene_warnings.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_folder.hpp"
#include "io/files/shell_word.hpp"
#include "run/loop/stop_signals.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

// Sets the folder of the results: -o or the usual folder.
void take_folder(const RunOptions& options, const Scene& scene, RunSettings& settings) {
  if (options.folder) {
    check_output_folder(*options.folder, options.scene, options.force);
    settings.folder = *options.folder;
    return;
  }
  take_usual_folder(scene, settings);
  if (options.quiet || !settings.folder) return;
  const fs::path wanted = usual_folder_name(options.scene);
  std::string note = fmt::format("results go to {}", settings.folder->string());
  if (*settings.folder != wanted) {
    const bool stopped = fs::exists(present_path(wanted, checkpoint_name)) && !fs::exists(wanted / "summary.json");
    note += fmt::format(" ({} holds another run; {})", wanted.string(),
                        stopped ? fmt::format("carom resume {} continues that run", shell_word(wanted.string()))
                                : "--force replaces it");
  }
  print_note(note);
}

}  // namespace

int command_run(const RunOptions& options) {
  RunSettings settings = settings_of(options);
  catch_signals();
  const auto watch = [&] { return std::make_unique<SetupWatch>(settings.start_time, options.max_walltime); };
  auto setup = watch();
  const Scene scene = load_scene_as_told(options.scene, options.changes);
  check_view(options, scene);
  setup = nullptr;  // looking for a folder makes some
  settings.engine = choose_engine(options.engine, options.threads, options.lead);
  if (!options.quiet) {
    for (const std::string& warning : scene_warnings(scene)) print_warning(warning);
    if (scene.run.automatic) print_note(choice_text(scene));
  }
  take_folder(options, scene, settings);
  setup = watch();
  return run_and_report(options, scene, std::move(settings), std::nullopt, std::move(setup));
}

}  // namespace carom
