#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/check.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

// Everything that a run may write. summary.json goes last: it is the sign that the rest is there.
constexpr std::array result_names{"scene.toml",   "trajectory.xyz", "trajectory.h5", "trajectory.xdmf", "series.csv",
                                  "velocity.svg", "energy.svg",     "movie.mp4",     "frames",          "summary.json"};

// A name that nobody else gives a folder, because --force removes it.
fs::path unfinished_of(const fs::path& folder) {
  return folder / "carom-unfinished";
}

// folder/ and folder are the same, and "" is the current one.
fs::path normal(const fs::path& folder) {
  const fs::path tidy = (folder.empty() ? fs::path(".") : folder).lexically_normal();
  return tidy.has_filename() ? tidy : tidy.parent_path();
}

// Whether a folder holds PNG frames of ours and nothing else, so that it may be replaced as a whole.
bool holds_frames_only(const fs::path& frames) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(frames, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("frame_") || !name.ends_with(".png")) return false;
  }
  return !error;
}

[[noreturn]] void fail(const char* what, const fs::path& path, const std::error_code& error) {
  throw RunError(fmt::format("cannot {} {}: {}", what, path.string(), error.message()));
}

}  // namespace

void check_output_folder(const fs::path& name, const fs::path& input, bool force) {
  const fs::path folder = normal(name);
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: is a file; expected a folder for the results (-o)", name.string()));
  }
  for (const char* const result : result_names) {
    if (fs::equivalent(folder / result, input, error)) {
      throw InputError(
          fmt::format("{}: the run's {} would replace the scene file itself; choose another folder with -o",
                      name.string(), result));
    }
    if (!force && fs::exists(folder / result, error)) {
      throw InputError(
          fmt::format("{}: holds {} of an earlier run; choose another folder with -o, or replace it with "
                      "--force",
                      name.string(), result));
    }
  }
  if (fs::exists(folder / "frames", error) && !holds_frames_only(folder / "frames")) {
    throw InputError(fmt::format("{}: holds a folder 'frames' with other files in it; choose another folder with -o",
                                 name.string()));
  }
  if (!force && fs::exists(unfinished_of(folder), error)) {
    throw InputError(
        fmt::format("{}: another run is writing there, or stopped before its end ({}); choose another "
                    "folder with -o, or replace it with --force",
                    name.string(), unfinished_of(folder).string()));
  }
}

OutputFolder::OutputFolder(const fs::path& folder, const fs::path& input, bool force)
    : folder_(normal(folder)), unfinished_(unfinished_of(folder_)) {
  check_output_folder(folder, input, force);
  std::error_code error;
  for (fs::path p = folder_; !p.empty() && !fs::exists(p, error); p = p.parent_path()) made_.insert(made_.begin(), p);
  fs::remove_all(unfinished_, error);
  fs::create_directories(unfinished_, error);
  if (!error) return;
  const std::error_code why = error;
  remove_unfinished();
  if (why == std::errc::no_space_on_device) fail("make the folder", unfinished_, why);
  throw InputError(
      fmt::format("{}: cannot be made: {}; expected a folder for the results (-o)", name(), why.message()));
}

OutputFolder::~OutputFolder() {
  if (!done_) remove_unfinished();
}

void OutputFolder::remove_unfinished() noexcept {
  std::error_code ignored;
  fs::remove_all(unfinished_, ignored);
  // Folders that we made go too, if nobody else put anything there: remove() takes empty ones only.
  for (auto p = made_.rbegin(); p != made_.rend(); ++p) fs::remove(*p, ignored);
}

void OutputFolder::finish() {
  std::error_code error;
  // The old summary goes first: from here on the folder does not look complete until it is.
  for (auto name = result_names.rbegin(); name != result_names.rend(); ++name) {
    if (std::string_view(*name) == "frames") {
      fs::remove_all(folder_ / *name, error);
    } else {
      fs::remove(folder_ / *name, error);
    }
    if (error) fail("replace", folder_ / *name, error);
  }
  for (const char* const name : result_names) {
    if (!fs::exists(unfinished_ / name, error)) continue;
    fs::rename(unfinished_ / name, folder_ / name, error);
    if (error) fail("write", folder_ / name, error);
  }
  fs::remove_all(unfinished_, error);
  done_ = true;
}

std::string OutputFolder::keep_unfinished() {
  done_ = true;
  return unfinished_.string();
}

}  // namespace carom
