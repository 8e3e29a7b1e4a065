// A scene run from its first step to its results: all of `carom run` and `carom resume` but what they print.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/wall_clock.hpp"
#include "core/scene/scene.hpp"
#include "core/start/growth.hpp"
#include "io/checkpoint/checkpoint_place.hpp"
#include "io/files/output_folder.hpp"
#include "run/engine/make_engine.hpp"
#include "run/results/summary.hpp"

namespace carom {

// What a run tells the program that started it, while it goes on, on the thread that called run(). Each may be empty.
struct RunListener {
  std::function<void(const GrowthProgress&)> growth;  // GrowthTools::watch, for the initial state
  std::function<void()> ready;                        // the disks are there, nothing has been written yet
  // The first step is next, with so many disks; then, about a hundred times a second. The disks of the states are those
  // of one rank.
  std::function<void(const State&, Count)> begins;
  std::function<void(const State&)> progress;
  std::function<void(std::string_view)> note, warning;  // a line each
  std::function<std::string()> stop;                    // as often as progress: why the run shall stop; empty: go on
};

// How a scene is run.
struct RunSettings {
  EngineChoice engine = choose_engine("", std::nullopt);
  std::optional<std::filesystem::path> folder;                    // for the results; absent: no files
  std::optional<UsualFolder> usual;                               // where that is its first_free: see OutputFolder
  double max_walltime = std::numeric_limits<double>::infinity();  // seconds from start_time
  bool force = false;                                             // replaces the results that the folder holds
  bool strict = false;                                            // the first warning of the physics ends the run
  WallClock::time_point start_time = WallClock::now();
  RunListener listener;
};

// What a run came to.
struct RunOutcome {
  Summary summary;
  std::string folder;         // of the results, as it was named; empty if there are none
  std::string stopped_by;     // why it stopped early, such as "SIGTERM"; empty: it came to its end
  std::string lost_pictures;  // plots, a movie and a page that could not be made, and how to make them; empty if none
};

// Where a run goes on.
struct ResumeFrom {
  Checkpoint checkpoint;
  CheckpointPlace place;
  std::unique_ptr<DiskSource> disks = nullptr;  // where ranks take them; else they are in the checkpoint's state
};

// Runs the scene to scene.run.t_end, or until a stop is asked for, with all files that it asks for. Throws InputError
// (a folder that holds another run, disks that do not fit), PhysicsError (the method cannot go on; what was written is
// kept), RunError (the machine: a full disk; with the command that goes on, where there is a checkpoint).
// Precondition: the scene was read by load_scene or parse_scene.
RunOutcome run(const Scene& scene, RunSettings settings);

// Goes on from a checkpoint, bit for bit as if never stopped. scene: that of the checkpoint, with a later end perhaps.
// Precondition: check_resumable (resume_checks.hpp). Throws as run() does.
RunOutcome resume(const Scene& scene, ResumeFrom from, RunSettings settings);

// Sets the folder for the results of a scene where none was named: none if the scene asks for no files, else out/NAME
// of the scene's file, and the first free of out/NAME-2 and so on where that holds a run; with settings.force always
// out/NAME. Throws InputError where it cannot take them.
void take_usual_folder(const Scene& scene, RunSettings& settings);

}  // namespace carom
