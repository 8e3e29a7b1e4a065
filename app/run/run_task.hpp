// A run that is ready to start: what `carom run` and `carom resume` hand over to be carried out.
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "app/run/setup_watch.hpp"
#include "core/scene/scene.hpp"
#include "io/checkpoint/checkpoint_place.hpp"
#include "run/make_engine.hpp"

namespace carom {

// Where a run goes on.
struct ResumeFrom {
  Checkpoint checkpoint;
  CheckpointPlace place;
};

struct RunTask {
  std::chrono::steady_clock::time_point start_time;
  Scene scene;
  EngineChoice choice;
  std::optional<std::filesystem::path> folder;                    // for the results; absent if there are none
  std::optional<ResumeFrom> from;                                 // absent: from the scene's start
  double max_walltime = std::numeric_limits<double>::infinity();  // seconds from start_time
  bool json = false, quiet = false, force = false, strict = false;
  std::unique_ptr<SetupWatch> setup = nullptr;  // until the first step
};

// Runs to the end, or until a stop is requested, and reports. Returns the exit status: 0, 4 if stopped early, or 1 if a
// picture could not be made.
int carry_out(RunTask task);

}  // namespace carom
