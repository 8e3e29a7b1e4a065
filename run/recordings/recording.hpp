// The trajectory of a run, finished or not, found by the name of its folder, and what lies beside it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

struct Recording {
  std::filesystem::path folder;  // where files go
  std::filesystem::path trajectory;
  bool growing = false;  // a run is, or was, writing it
};

// name: a folder of a run, or a trajectory. Throws InputError where there is none.
Recording open_recording(const std::string& name);

std::unique_ptr<TrajectoryReader> open_frames(const Recording& recording);

// Takes a warning, one line.
using WarningSink = std::function<void(std::string_view)>;

// The run's own scene where it lies beside the trajectory; a warning, and none, where it cannot be read, or has another
// box than the trajectory.
std::optional<Scene> scene_of(const Recording& recording, const WarningSink& warn);

// Throws InputError where a file is in the way.
void check_free(const std::filesystem::path& file, bool force);

// Throws InputError, naming the file, where it cannot be written, or the folders made that it lacks. To be asked early,
// before anything takes time; changes nothing.
void check_writable(const std::filesystem::path& file);

}  // namespace carom
