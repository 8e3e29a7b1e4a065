#include "io/checkpoint/checkpoint_place.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/base/input_message.hpp"
#include "io/files/checkpoint_names.hpp"
#include "io/files/output_file.hpp"
#include "io/files/output_folder.hpp"
#include "io/files/shell_word.hpp"

namespace carom {

namespace fs = std::filesystem;

void save_checkpoint(const std::string& folder, const RunRecord& record, const StatePieces& state) {
  const fs::path newest = fs::path(folder) / checkpoint_name;
  const fs::path previous = fs::path(folder) / previous_checkpoint_name;
  const fs::path beside = fs::path(folder) / "checkpoint.new.carom";
  std::error_code error;
  try {
    write_checkpoint(beside.string(), record, state);
  } catch (const RunError&) {
    fs::remove(beside, error);  // a full disk needs the room
    throw;
  }
  // A hard link keeps the newest checkpoint under a name at every moment. On file systems without hard links, there is
  // a moment in which only the previous one exists.
  fs::remove(previous, error);
  fs::create_hard_link(newest, previous, error);
  if (error && fs::exists(newest)) fs::rename(newest, previous, error);
  rename_file(beside, newest);
  sync_path(folder);
}

namespace {

[[noreturn]] void fail_without_checkpoint(const std::string& name, const fs::path& folder) {
  if (is_being_written(folder)) {
    fail_input(name, "another run is writing there, and has no checkpoint yet",
               "expected the folder of a run that has stopped");
  }
  std::error_code error;
  if (!fs::exists(folder / "summary.json", error)) {
    fail_input(name, "holds no checkpoint", "expected a checkpoint, or the folder of a run that wrote one");
  }
  const fs::path previous = folder / previous_checkpoint_name;
  if (fs::exists(previous, error)) {
    fail_input(name, fmt::format("lacks its {}", checkpoint_name),
               fmt::format("the earlier one is there: carom resume {} --t-end T", shell_word(previous.string())));
  }
  fail_input(
      name, "holds a finished run that kept no checkpoint",
      fmt::format("to go further, run it again with one: carom run {} --set output.checkpoint=600 --t-end T -o DIR",
                  shell_word((folder / "scene.toml").string())));
}

}  // namespace

CheckpointPlace find_checkpoint(const std::string& name) {
  std::error_code error;
  fs::path file = fs::path(name).lexically_normal();
  if (fs::is_directory(file, error)) {
    const fs::path folder = file.has_filename() ? file : file.parent_path();
    file = folder / unfinished_name / checkpoint_name;
    if (!fs::exists(file, error)) file = folder / checkpoint_name;
    if (!fs::exists(file, error)) file = folder / unfinished_name / previous_checkpoint_name;
    if (!fs::exists(file, error)) fail_without_checkpoint(name, folder);
  }
  if (!fs::exists(file, error)) fail_input(name, "does not exist", "expected a checkpoint, or the folder of a run");
  const fs::path beside = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const fs::path whole = fs::canonical(beside, error);
  if (whole.filename() != unfinished_name) return {file, beside, true};
  const fs::path folder = beside.filename() == unfinished_name ? beside.parent_path() : whole.parent_path();
  return {file, folder.empty() ? fs::path(".") : folder, false};
}

namespace {

template <class Read>
auto read_at(const CheckpointPlace& place, Read&& read) {
  try {
    return read(place.file.string());
  } catch (const InputError& error) {
    const fs::path previous = place.file.parent_path() / previous_checkpoint_name;
    if (place.file.filename() != checkpoint_name) throw;  // there is no previous one for such a file
    try {
      read_checkpoint(previous.string());
    } catch (const InputError&) {
      // For a checkpoint of another version the message names the program that can read it.
      if (std::string_view(error.what()).find("is damaged") == std::string_view::npos) throw error;
      throw InputError(fmt::format("{}; there is no intact earlier one, so run the scene again", error.what()));
    }
    throw InputError(
        fmt::format("{}; the earlier one is intact: carom resume {}", error.what(), shell_word(previous.string())));
  }
}

}  // namespace

Checkpoint read_checkpoint_at(const CheckpointPlace& place) {
  return read_at(place, read_checkpoint);
}

CheckpointInPieces read_checkpoint_in_pieces_at(const CheckpointPlace& place) {
  return read_at(place, read_checkpoint_in_pieces);
}

}  // namespace carom
