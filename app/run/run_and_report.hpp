// A run on the command line: progress and warnings on standard error, the results on standard output.
#pragma once

#include <memory>
#include <optional>

#include "app/cli/command_line.hpp"
#include "app/run/setup_watch.hpp"
#include "run/scene/run_scene.hpp"

namespace carom {

// Throws InputError if --view needs files that the scene does not write.
void check_view(const CarryOptions& options, const Scene& scene);

// The settings of a run from the options, except for its engine and its folder.
RunSettings settings_of(const CarryOptions& options);

// Runs the scene, or continues from a checkpoint, and reports. setup: ends when the disks have been made; may be null.
// Returns the exit status: 0, 4 if stopped early, or 1 if a picture could not be made. Throws as run() does.
int run_and_report(const CarryOptions& options, const Scene& scene, RunSettings settings,
                   std::optional<ResumeFrom> from, std::unique_ptr<SetupWatch> setup);

}  // namespace carom
