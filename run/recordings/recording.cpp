#include "run/recordings/recording.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "core/load/scene_file.hpp"
#include "io/files/output_folder.hpp"

namespace carom {

namespace fs = std::filesystem;

std::optional<FileIdentity> identity_of(const fs::path& file) {
  struct stat status {};
  if (file.empty() || stat(file.c_str(), &status) != 0) return {};
  return FileIdentity{status.st_dev, status.st_ino};
}

Recording open_recording(const std::string& name) {
  const fs::path path = name;
  check_present(name);
  const auto found = [](const fs::path& folder, const fs::path& trajectory, bool growing) {
    return Recording{folder, trajectory, growing, identity_of(trajectory)};
  };
  if (!fs::is_directory(path)) {
    const fs::path parent = path.parent_path();
    return found(parent.empty() ? fs::path(".") : parent, path, parent.filename() == unfinished_name);
  }
  const fs::path trajectory = trajectory_in(path);
  if (!trajectory.empty()) return found(path, trajectory, path.filename() == unfinished_name);
  const fs::path unfinished = trajectory_in(path / unfinished_name);
  if (!unfinished.empty()) return found(path, unfinished, true);
  fail_input(name, "holds no trajectory.xyz or trajectory.h5",
             "expected the folder of a run with [output] trajectory = \"xyz\" or \"h5md\"");
}

std::unique_ptr<TrajectoryReader> open_frames(const Recording& recording) {
  std::unique_ptr<TrajectoryReader> reader = open_trajectory(recording.trajectory.string(), recording.growing);
  if (recording.file && identity_of(recording.trajectory) != recording.file) fail_replaced(recording);
  return reader;
}

void fail_replaced(const Recording& recording) {
  fail_input(recording.trajectory.string(), "was replaced while it was read",
             "expected a file that does not change; repeat the command to read the new one");
}

std::string note_of_another_run(const Recording& recording) {
  if (recording.growing || !is_being_written(recording.folder)) return "";
  return fmt::format("{} belongs to an earlier run than the one in progress in {}", recording.trajectory.string(),
                     (recording.folder / unfinished_name).string());
}

namespace {

// A trajectory that cannot be read is reported when its frames are read.
bool has_other_box(const Recording& recording, const Domain& box) {
  try {
    TrajectoryFrame first;
    if (!open_frames(recording)->read(first)) return false;
    return !is_in_box(first, box);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<Scene> scene_of(const Recording& recording, const WarningSink& warn) {
  const fs::path file = recording.trajectory.parent_path() / "scene.toml";
  if (!fs::exists(file)) return {};
  try {
    Scene scene = load_scene(file.string());
    if (!has_other_box(recording, scene.box)) return scene;
    fail_input(file.string(), fmt::format("has another box than {}", recording.trajectory.filename().string()));
  } catch (const InputError& error) {
    warn(fmt::format("title and sides come from the trajectory alone: {}", error.what()));
    return {};
  }
}

void check_free(const fs::path& file, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::status_known(status)) {
    fail_input(file.string(), "cannot be written: " + error.message(), "expected another file (-o)");
  }
  if (fs::is_directory(status)) fail_input(file.string(), "is a folder", "expected a file (-o)");
  if (fs::exists(status) && !force) {
    fail_input(file.string(), "exists already", "choose another file with -o, or replace it with --force");
  }
}

void check_writable(const fs::path& file) {
  std::error_code error;
  fs::path folder = file.parent_path();
  while (!folder.empty() && !fs::exists(folder, error)) folder = folder.parent_path();
  // Of "." in a file that is no folder the system says just that.
  if (access((folder / ".").c_str(), W_OK | X_OK) == 0) return;
  fail_input(file.string(), fmt::format("cannot be written: {}", std::strerror(errno)),
             "expected a file in another folder (-o)");
}

}  // namespace carom
