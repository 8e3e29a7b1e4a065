#include "io/files/output_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "core/scene/scene_names.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/shell_word.hpp"

namespace carom {

namespace fs = std::filesystem;

namespace {

// All files that a run may write. summary.json is the last one to be moved: it is the sign that the rest is there.
constexpr std::array result_names{"scene.toml",
                                  "trajectory.xyz",
                                  "trajectory.h5",
                                  "trajectory.xdmf",
                                  "series.csv",
                                  "analysis.h5",
                                  "velocity.svg",
                                  "energy.svg",
                                  "pair_correlation.svg",
                                  "displacement.svg",
                                  "speeds.svg",
                                  "density.svg",
                                  "pressure.svg",
                                  "collision_rate.svg",
                                  "profile.svg",
                                  "velocity_autocorrelation.svg",
                                  "structure_factor.svg",
                                  "bond_order.svg",
                                  "bond_correlation.svg",
                                  "bond_autocorrelation.svg",
                                  "movie.mp4",
                                  "frames",
                                  "view.html",
                                  previous_checkpoint_name,
                                  checkpoint_name,
                                  "summary.json"};

constexpr bool is_plot_of(std::string_view quantity, std::string_view name) {
  return name.starts_with(quantity) && name.substr(quantity.size()) == ".svg";
}

// io/plots draws each quantity of an analysis into a file with its name.
static_assert(std::all_of(quantity_names.begin(), quantity_names.end(), [](std::string_view quantity) {
  return std::any_of(result_names.begin(), result_names.end(),
                     [&](std::string_view name) { return is_plot_of(quantity, name); });
}));

bool is_checkpoint(std::string_view name) {
  return name == checkpoint_name || name == previous_checkpoint_name;
}

// Files that carom view and carom render also make of a run in its folder, even while it goes on.
bool is_picture(std::string_view name) {
  return name == "movie.mp4" || name == "frames" || name == "view.html";
}

// An empty folder in the unfinished one: its presence means that the pictures beside carom-unfinished are of an earlier
// run, which this one replaces.
constexpr const char* old_pictures_name = "replaces-pictures";

bool holds_pictures(const fs::path& folder) {
  std::error_code error;
  const auto is_there = [&](std::string_view name) { return is_picture(name) && fs::exists(folder / name, error); };
  return std::any_of(result_names.begin(), result_names.end(), is_there);
}

// A name that no other program is likely to use, because --force removes the folder.
fs::path unfinished_of(const fs::path& folder) {
  return folder / unfinished_name;
}

// folder/ and folder give the same path, and "" gives the current folder.
fs::path normal(const fs::path& folder) {
  const fs::path tidy = (folder.empty() ? fs::path(".") : folder).lexically_normal();
  return tidy.has_filename() ? tidy : tidy.parent_path();
}

// This folder and those above it that do not exist, innermost first. A link counts as existing, whatever it leads to:
// it belongs to its owner, and is not removed again.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path p = folder; !p.empty() && fs::symlink_status(p, error).type() == fs::file_type::not_found;
       p = p.parent_path()) {
    missing.push_back(p);
  }
  return missing;
}

// Throws for a link that leads nowhere, such as to a disk that is not mounted.
void check_links(const fs::path& name, const fs::path& folder) {
  std::error_code error;
  for (fs::path p = folder; !p.empty() && p != p.parent_path(); p = p.parent_path()) {
    if (fs::exists(p, error) || !fs::is_symlink(fs::symlink_status(p, error))) continue;
    throw InputError(
        fmt::format("{}: cannot be made: {} is a link to {}, which is not there; expected a folder for the "
                    "results (-o)",
                    name.string(), p.string(), fs::read_symlink(p, error).string()));
  }
}

// Makes a folder, and missing folders above it. A run that checks at the same moment whether it may write there
// (check_writable) removes what it made: a folder that this one has just found to exist, or in which it was about to
// make another; so this tries several times.
void make_folders(const fs::path& folder, std::error_code& error) {
  constexpr int attempts = 100;
  for (int k = 0; k < attempts; ++k) {
    fs::create_directories(folder, error);
    if (error != std::errc::no_such_file_or_directory && error != std::errc::file_exists) return;
  }
}

// Removes what an earlier run has left. Precondition: the folder is locked, so no other run has just made it.
void remove_all_but_lock(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder, error)) left.push_back(entry.path());
  for (const fs::path& path : left) {
    if (!error && path.filename() != folder_lock_name) fs::remove_all(path, error);
  }
}

// The reason why no folder can be made here, found by making one and removing it; none if only the disk is full.
std::error_code why_not_writable(const fs::path& folder) {
  std::error_code error;
  const fs::path probe = folder / fmt::format("carom-probe-{}", getpid());
  make_folders(probe, error);
  const std::error_code why = error;
  fs::remove(probe, error);
  return why == std::errc::no_space_on_device ? std::error_code{} : why;
}

// Checks that a folder could be made here. Missing folders above it are made and removed again.
void check_writable(const fs::path& name, const fs::path& folder) {
  check_links(name, folder);
  std::error_code error;
  const std::vector<fs::path> made = missing_folders(folder);
  const std::error_code why = why_not_writable(folder);
  for (const fs::path& p : made) fs::remove(p, error);  // removes empty folders only
  if (!why) return;
  throw InputError(fmt::format("{}: cannot be {}: {}; expected a folder for the results (-o)", name.string(),
                               made.empty() ? "written to" : "made", why.message()));
}

[[noreturn]] void fail_locked(const fs::path& name) {
  throw InputError(fmt::format("{}: another run is writing there; expected another folder (-o)", name.string()));
}

[[noreturn]] void fail(const char* what, const fs::path& path, const std::error_code& error) {
  throw RunError(fmt::format("cannot {} {}: {}", what, path.string(), error.message()));
}

// May the run put this file or folder there? name: of the run's folder, as given. Throws InputError if it may not.
void check_place_of_result(const fs::path& name, const char* result, const fs::path& input, bool force) {
  const fs::path place = normal(name) / result;
  std::error_code error;
  if (fs::equivalent(place, input, error)) {
    throw InputError(fmt::format("{}: the run's {} would replace the scene file itself; choose another folder with -o",
                                 name.string(), result));
  }
  // A file does not replace a folder; the end of a run would be too late to find that out. A link is replaced itself.
  if (std::string_view(result) != "frames" && fs::is_directory(fs::symlink_status(place, error))) {
    throw InputError(fmt::format("{}: is a folder, but the run writes its {} there; choose another folder with -o",
                                 (name / result).string(), result));
  }
  if (!force && fs::exists(place, error)) {
    throw InputError(
        fmt::format("{}: holds {} of an earlier run; choose another folder with -o, or replace it with "
                    "--force",
                    name.string(), result));
  }
}

// Throws InputError if another run is writing there, or has left its files and these must not be replaced.
void check_unfinished(const fs::path& name, bool force) {
  const fs::path unfinished = unfinished_of(normal(name));
  std::error_code error;
  if (!fs::exists(unfinished, error)) return;
  if (is_locked(unfinished)) fail_locked(name);
  if (force) return;
  const std::string remedy = fs::exists(unfinished / checkpoint_name, error)
                                 ? fmt::format("resume it with carom resume {}, ", shell_word(name.string()))
                                 : "";
  throw InputError(
      fmt::format("{}: another run is writing there, or stopped before its end ({}); {}choose another "
                  "folder with -o, or replace it with --force",
                  name.string(), unfinished.string(), remedy));
}

bool holds_lock_alone(const fs::path& folder) {
  std::error_code error;
  return std::all_of(fs::directory_iterator(folder, error), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return entry.path().filename() == folder_lock_name; });
}

}  // namespace

bool holds_frames_only(const fs::path& frames) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(frames, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("frame_") || !name.ends_with(".png")) return false;
  }
  return !error;
}

fs::path present_path(const fs::path& folder, const std::string& file) {
  std::error_code error;
  const fs::path unfinished = unfinished_of(folder) / file, finished = folder / file;
  if (fs::exists(unfinished, error)) return unfinished;
  return fs::exists(finished, error) || !fs::exists(unfinished_of(folder), error) ? finished : unfinished;
}

bool is_being_written(const fs::path& folder) {
  return is_locked(unfinished_of(normal(folder)));
}

void check_output_folder(const fs::path& name, const fs::path& input, bool force) {
  const fs::path folder = normal(name);
  std::error_code error;
  if (fs::absolute(folder, error) == fs::absolute(folder, error).root_path()) {
    throw InputError(fmt::format("{}: is the root of all folders; expected a folder for this run, such as -o out/{}",
                                 name.string(), input.stem().string()));
  }
  // The status is read only once: another run that checks whether it may write there removes again what it made.
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw InputError(fmt::format("{}: is a file; expected a folder for the results (-o)", name.string()));
  }
  check_writable(name, folder);
  if (!fs::exists(folder, error)) return;
  for (const char* const result : result_names) check_place_of_result(name, result, input, force);
  if (fs::exists(folder / "frames", error) && !holds_frames_only(folder / "frames")) {
    throw InputError(fmt::format("{}: holds a folder 'frames' with other files in it; choose another folder with -o",
                                 name.string()));
  }
  check_unfinished(name, force);
}

OutputFolder::OutputFolder(const fs::path& folder, const fs::path& input, bool force) {
  begin(folder, input, force);
}

OutputFolder::OutputFolder(const UsualFolder& folder, const fs::path& input) {
  for (fs::path next = folder.first_free;;) {
    try {
      begin(next, input, false);
      return;
    } catch (const InputError&) {
      const fs::path other = free_output_folder(folder.usual, input);
      if (other == next) throw;
      next = other;
    }
  }
}

// If this throws, nothing stays locked or left behind.
void OutputFolder::begin(const fs::path& folder, const fs::path& input, bool force) {
  folder_ = normal(folder);
  unfinished_ = unfinished_of(folder_);
  check_output_folder(folder, input, force);
  std::error_code error;
  made_ = missing_folders(folder_);
  std::reverse(made_.begin(), made_.end());
  const fs::file_status before = fs::symlink_status(unfinished_, error);
  if (fs::exists(before) && !fs::is_directory(before)) fs::remove(unfinished_, error);
  make_folders(unfinished_, error);
  if (!error) {
    lock();
    if (!force) check_still_free(folder, input);
    remove_all_but_lock(unfinished_, error);
  }
  if (!error && holds_pictures(folder_)) fs::create_directory(unfinished_ / old_pictures_name, error);
  if (!error) return;
  const std::error_code why = error;
  remove_unfinished();
  if (why == std::errc::no_space_on_device) fail("make the folder", unfinished_, why);
  throw InputError(
      fmt::format("{}: cannot be made: {}; expected a folder for the results (-o)", name(), why.message()));
}

// Another run may have begun and ended there since the folder was checked: its results stay, and so does what it has
// left for a continuation. Precondition: the lock is held.
void OutputFolder::check_still_free(const fs::path& name, const fs::path& input) {
  if (!holds_lock_alone(unfinished_)) {
    lock_.give_up();
    check_unfinished(name, false);
    fail_locked(name);
  }
  try {
    for (const char* const result : result_names) check_place_of_result(name, result, input, false);
  } catch (const InputError&) {
    remove_unfinished();
    lock_.give_up();
    throw;
  }
}

OutputFolder::OutputFolder(const fs::path& folder)
    : folder_(normal(folder)), unfinished_(unfinished_of(folder_)), done_(true) {
  std::error_code error;
  make_folders(unfinished_, error);
  // Both folders may exist and not be writable, which would otherwise show only after some files have been moved.
  for (const fs::path& place : {folder_, unfinished_}) {
    if (!error) error = why_not_writable(place);
  }
  if (error)
    throw InputError(
        fmt::format("{}: cannot be written to: {}; resume in another folder with -o", name(), error.message()));
  lock();
}

OutputFolder::~OutputFolder() {
  if (!done_) remove_unfinished();
}

void OutputFolder::lock() {
  if (!lock_.take(unfinished_)) fail_locked(folder_);
}

void OutputFolder::take_back(bool finished, const std::vector<std::string>& files) {
  const auto take = [&](const fs::path& file) {
    std::error_code error;
    if (fs::exists(unfinished_ / file, error) || !fs::exists(folder_ / file, error)) return;
    fs::rename(folder_ / file, unfinished_ / file, error);
    if (error) fail("move", folder_ / file, error);
  };
  // The summary first: from here on the folder does not look complete until it is.
  for (auto name = result_names.rbegin(); finished && name != result_names.rend(); ++name) take(*name);
  for (const std::string& file : files) take(file);
}

void OutputFolder::remove_unfinished() noexcept {
  std::error_code ignored;
  fs::remove_all(unfinished_, ignored);
  // Folders that this object made are removed too, if they contain nothing else: remove() removes only empty ones.
  for (auto p = made_.rbegin(); p != made_.rend(); ++p) fs::remove(*p, ignored);
}

void OutputFolder::finish(bool keep_checkpoints) {
  std::error_code error;
  const bool pictures_are_old = fs::exists(unfinished_ / old_pictures_name, error);
  // The old summary is removed first: from here on the folder does not look complete until it is.
  for (auto name = result_names.rbegin(); name != result_names.rend(); ++name) {
    if (is_picture(*name) && !pictures_are_old && !fs::exists(unfinished_ / *name, error)) continue;
    if (std::string_view(*name) == "frames") {
      fs::remove_all(folder_ / *name, error);
    } else {
      fs::remove(folder_ / *name, error);
    }
    if (error) fail("replace", folder_ / *name, error);
  }
  for (const char* const name : result_names) {
    if (!fs::exists(unfinished_ / name, error) || (is_checkpoint(name) && !keep_checkpoints)) continue;
    fs::rename(unfinished_ / name, folder_ / name, error);
    if (error) fail("write", folder_ / name, error);
  }
  fs::remove_all(unfinished_, error);
  done_ = true;
  lock_.give_up();
}

std::string OutputFolder::keep_unfinished() {
  done_ = true;
  return unfinished_.string();
}

}  // namespace carom
