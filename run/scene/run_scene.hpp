// Runs a scene from its first step to its results: everything in `carom run` and `carom resume` except their output.
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

// Calls from a run to the program that started it, on the thread that called run(). Each may be empty.
struct RunListener {
  std::function<void(const GrowthProgress&)> growth;  // GrowthTools::watch, for the initial state
  std::function<void()> ready;                        // the disks have been made, nothing has been written yet
  // begins: before the first step, with the number of disks; progress: from then on about a hundred times a second. The
  // disks of the states are those of one rank.
  std::function<void(const State&, Count)> begins;
  std::function<void(const State&)> progress;
  std::function<void(std::string_view)> note, warning;  // a line each
  std::function<std::string()> stop;  // called as often as progress: a reason to stop the run; empty to go on
};

// How a scene is run.
struct RunSettings {
  EngineChoice engine = choose_engine("", std::nullopt);
  std::optional<std::filesystem::path> folder;                    // for the results; absent: no files
  std::optional<UsualFolder> usual;                               // if folder is its first_free: see OutputFolder
  double max_walltime = std::numeric_limits<double>::infinity();  // seconds from start_time
  bool force = false;                                             // replaces existing results in the folder
  bool strict = false;                                            // the first warning of the physics ends the run
  WallClock::time_point start_time = WallClock::now();
  RunListener listener;
};

// The results of a run.
struct RunOutcome {
  Summary summary;
  std::string folder;         // of the results, as it was named; empty if there are none
  std::string stopped_by;     // the reason for an early stop, such as "SIGTERM"; empty if the run came to its end
  std::string lost_pictures;  // plots, movie and page that could not be made, and how to make them; empty if none
};

// The checkpoint from which a run is continued.
struct ResumeFrom {
  Checkpoint checkpoint;
  CheckpointPlace place;
  std::unique_ptr<DiskSource> disks = nullptr;  // if ranks take the disks from it; otherwise the state has them
};

// Runs the scene to scene.run.t_end, or until a stop is requested, and writes its files. Throws InputError (the folder
// holds another run, the disks do not fit), PhysicsError (the method cannot go on; files written so far are kept),
// RunError (the machine, such as a full disk; with the command that continues, if there is a checkpoint). Precondition:
// the scene was read by load_scene or parse_scene.
RunOutcome run(const Scene& scene, RunSettings settings);

// Continues from a checkpoint, bit for bit as if the run had never stopped. scene: that of the checkpoint, possibly
// with a later end. Precondition: check_resumable (resume_checks.hpp). Throws as run() does.
RunOutcome resume(const Scene& scene, ResumeFrom from, RunSettings settings);

// Sets the folder for the results of a scene if none was named: none if the scene writes no files, otherwise out/NAME
// of the scene's file, or the first free of out/NAME-2 and so on if that holds a run; with settings.force always
// out/NAME. Throws InputError if it cannot take results.
void take_usual_folder(const Scene& scene, RunSettings& settings);

}  // namespace carom
