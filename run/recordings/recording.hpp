// The trajectory of a run, finished or not, found by the name of its folder, and what lies beside it.
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

// What tells a file from all others, also when it has moved within its file system. While it is open no other has it.
struct FileIdentity {
  dev_t device = 0;
  ino_t number = 0;
  bool operator==(const FileIdentity&) const = default;
};

// Nothing where there is no such file.
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);

struct Recording {
  std::filesystem::path folder;  // where files go
  std::filesystem::path trajectory;
  bool growing = false;                // a run is, or was, writing it
  std::optional<FileIdentity> file{};  // the trajectory that was found
};

// name: a folder of a run, or a trajectory. Throws InputError where there is none.
Recording open_recording(const std::string& name);

// Throws InputError where another run has put its own trajectory in the place of the one that was found: what has been
// read of that says nothing of this.
std::unique_ptr<TrajectoryReader> open_frames(const Recording& recording);

// What is said of a trajectory that is no longer what it was.
[[noreturn]] void fail_replaced(const Recording& recording);

// Where the run of a folder has ended and another is going on in its place: a sentence for the user; else empty.
std::string note_of_another_run(const Recording& recording);

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
