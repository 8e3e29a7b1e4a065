#include "app/run/run_and_report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/cli/commands.hpp"
#include "app/cli/messages.hpp"
#include "app/cli/progress.hpp"
#include "app/run/growth_line.hpp"
#include "app/view/open_page.hpp"
#include "core/base/input_message.hpp"

namespace carom {

namespace {

// Runs the scene and shows its messages as they come, above a line of progress.
RunOutcome run_shown(const CarryOptions& options, const Scene& scene, RunSettings settings,
                     std::optional<ResumeFrom> from, std::unique_ptr<SetupWatch> setup) {
  std::optional<Progress> progress;
  RunListener& listener = settings.listener;
  listener.ready = [&] { setup = nullptr; };
  if (!options.quiet) {
    const auto clear = [&] {
      if (progress) progress->clear();
    };
    listener.growth = growth_line(!from);
    listener.begins = [&](const State& state, Count disks) { progress.emplace(true, scene.run.t_end, state, disks); };
    listener.progress = [&](const State& state) { progress->update(state); };
    listener.note = [=](std::string_view text) { clear(), print_note(text); };
    listener.warning = [=](std::string_view text) { clear(), print_warning(text); };
  }
  return from ? resume(scene, std::move(*from), std::move(settings)) : run(scene, std::move(settings));
}

// Opens the page of the run, which it makes first unless the scene already did. One left from an earlier run is
// replaced.
void view_results(const CarryOptions& options, const Scene& scene, const std::filesystem::path& folder) {
  if (!scene.output.view) {
    ViewOptions view;
    view.source = folder.string();
    view.quiet = options.quiet || options.json;
    view.force = true;
    command_view(view);
  }
  const std::filesystem::path page = std::filesystem::absolute(folder / "view.html");
  if (std::filesystem::exists(page)) open_page(page.string(), "--view", options.quiet);
}

}  // namespace

void check_view(const CarryOptions& options, const Scene& scene) {
  if (!options.view || scene.output.trajectory != TrajectoryFormat::none) return;
  fail_input("--view", "the scene writes no trajectory",
             "expected a trajectory, as with --set 'output.trajectory=\"h5md\"' --set output.every=0.1");
}

RunSettings settings_of(const CarryOptions& options) {
  RunSettings settings;
  settings.max_walltime = options.max_walltime;
  settings.force = options.force;
  settings.strict = options.strict;
  return settings;
}

int run_and_report(const CarryOptions& options, const Scene& scene, RunSettings settings,
                   std::optional<ResumeFrom> from, std::unique_ptr<SetupWatch> setup) {
  if (!options.quiet && options.threads.value_or(1) > settings.engine.threads) {
    print_note(fmt::format("--threads {}: the reference engine uses one thread", *options.threads));
  }
  const RunOutcome outcome = run_shown(options, scene, std::move(settings), std::move(from), std::move(setup));
  const Summary& summary = outcome.summary;
  const bool stopped = !outcome.stopped_by.empty();
  if (stopped) {
    print_note(fmt::format("stopped by {} at t = {:g} of {:g}; resume it with {}", outcome.stopped_by, summary.time,
                           scene.run.t_end, summary.resume_with));
  }
  if (options.json) {
    print_out(json_text(summary));
  } else if (!options.quiet && !stopped) {
    print_out(table_text(summary, outcome.folder));
  }
  if (stopped) return 4;
  if (options.view) view_results(options, scene, outcome.folder);
  if (outcome.lost_pictures.empty()) return 0;
  print_note(fmt::format("error: {}", outcome.lost_pictures));
  return 1;
}

}  // namespace carom
