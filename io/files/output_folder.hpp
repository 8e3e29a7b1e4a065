// The place of a run's files, such that a folder always contains a complete result, which is never lost by accident.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/files/folder_lock.hpp"
#include "io/files/usual_folder.hpp"

namespace carom {

inline constexpr const char* unfinished_name = "carom-unfinished";

// The files of a run grow in FOLDER/carom-unfinished, where they can be watched, and are moved to FOLDER when the run
// is done, summary.json last. A folder with summary.json holds a complete result; a run that was killed leaves only
// carom-unfinished.
class OutputFolder {
 public:
  // Continues in a FOLDER whose run did not come to its end, or is continued beyond it. Uses the files that exist and
  // never removes them. Throws InputError if another process is writing there.
  explicit OutputFolder(const std::filesystem::path& folder);

  // Makes FOLDER (parents too) and FOLDER/carom-unfinished. Existing results are refused with InputError unless force
  // is set; then they stay until finish() replaces them. input is the scene file: an output never replaces it, with
  // force or without. Files that are not Carom's always stay as they are. Throws InputError if the folder cannot be
  // made, RunError if that is only because the disk is full.
  OutputFolder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);

  // The same in first_free, or in the folder that is free now if another run has taken that in the meantime: several
  // runs of a scene that begin at the same time find the same one free, and write much later.
  OutputFolder(const UsualFolder& folder, const std::filesystem::path& input);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Without finish() or keep_unfinished(), all files that the run wrote are removed.
  ~OutputFolder();

  // The path for a file while the run goes on.
  std::string path(const std::string& file) const { return (unfinished_ / file).string(); }

  // The folder in which files are written while the run goes on.
  std::string unfinished() const { return unfinished_.string(); }

  // The folder as the user named it.
  std::string name() const { return folder_.string(); }

  // Moves files that finish() has moved, or began to move, back to carom-unfinished: all results of a run that
  // finished, otherwise these files.
  void take_back(bool finished, const std::vector<std::string>& files);

  // Moves all files to FOLDER, replacing those of an earlier run; checkpoints only if they are to be kept. A movie,
  // frames or a page that carom view or carom render have made of this run stay, unless it has its own. Throws
  // RunError.
  void finish(bool keep_checkpoints = false);

  // Leaves the files as they are, for inspection of a run that failed. Returns its path.
  std::string keep_unfinished();

  // Reverts keep_unfinished(): the files are removed with this object.
  void discard() { done_ = false; }

 private:
  void begin(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);
  void check_still_free(const std::filesystem::path& name, const std::filesystem::path& input);
  void remove_unfinished() noexcept;
  void lock();

  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  std::vector<std::filesystem::path> made_;  // folders that were made, innermost last
  bool done_ = false;
  FolderLock lock_;  // on carom-unfinished
};

// The path of a run's file: in folder/carom-unfinished, or in folder if the run has finished. For a file in neither,
// the path in carom-unfinished if that exists.
std::filesystem::path present_path(const std::filesystem::path& folder, const std::string& file);

// Does a folder contain only PNG frames of Carom, so that it may be replaced as a whole?
bool holds_frames_only(const std::filesystem::path& frames);

// Is a run writing into a folder now?
bool is_being_written(const std::filesystem::path& folder);

// Throws InputError if `folder` cannot take the results of a run on the scene file `input`; changes nothing. Should be
// called early, before anything that takes time.
void check_output_folder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);

}  // namespace carom
