// The recording of a run, finished or not: its trajectory, found by the name of its folder, and the files beside it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"
#include "io/trajectory/trajectory_reader.hpp"

namespace carom {

// The identity of a file, which it keeps when it is moved within its file system; unique while the file is open.
struct FileIdentity {
  dev_t device = 0;
  ino_t number = 0;
  bool operator==(const FileIdentity&) const = default;
};

// Nothing if there is no such file.
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);

struct Recording {
  std::filesystem::path folder;  // where files go
  std::filesystem::path trajectory;
  bool growing = false;                // a run is, or was, writing it
  std::optional<FileIdentity> file{};  // the trajectory that was found
};

// name: a folder of a run, or a trajectory. Throws InputError if there is none.
Recording open_recording(const std::string& name);

// Throws InputError if the trajectory has been replaced by that of another run, so that data read before do not belong
// to it.
std::unique_ptr<TrajectoryReader> open_frames(const Recording& recording);

// Throws the InputError about a replaced trajectory.
[[noreturn]] void fail_replaced(const Recording& recording);

// A sentence for the user if the run of a folder has ended and another one is running in its place; else empty.
std::string note_of_another_run(const Recording& recording);

// Takes a warning, one line.
using WarningSink = std::function<void(std::string_view)>;

// The run's scene, if it lies beside the trajectory. If it cannot be read, or has another box than the trajectory,
// there is a warning and no scene.
std::optional<Scene> scene_of(const Recording& recording, const WarningSink& warn);

// Throws InputError if the file exists and force is not set, or if it is a folder.
void check_free(const std::filesystem::path& file, bool force);

// Throws InputError, naming the file, if it, or a missing folder of it, cannot be made. Changes nothing; to be called
// before any long work.
void check_writable(const std::filesystem::path& file);

}  // namespace carom
