// Where the files of a run go, so that what lies in a folder is always a whole result and never lost by accident.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/files/folder_lock.hpp"
#include "io/files/usual_folder.hpp"

namespace carom {

inline constexpr const char* unfinished_name = "carom-unfinished";

// The files of a run grow in FOLDER/carom-unfinished, where they can be watched, and move up to FOLDER when the run is
// done, summary.json last. A folder with summary.json holds a complete result; a run that was killed leaves
// carom-unfinished only.
class OutputFolder {
 public:
  // Goes on in a FOLDER whose run did not come to its end, or is to go on beyond it. Takes what is there as it is and
  // never removes it. Throws InputError where another process is writing there.
  explicit OutputFolder(const std::filesystem::path& folder);

  // Makes FOLDER (parents too) and FOLDER/carom-unfinished. Existing results are refused with InputError unless force
  // is set; then they stay until finish() replaces them. input is the scene file: an output never replaces it, force or
  // not. Files that are not Carom's are left alone always. Throws InputError if the folder cannot be made, RunError if
  // only the disk is full.
  OutputFolder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);

  // Likewise in first_free, or, where another run has taken that by now, in the one that is free now. Runs of one scene
  // that begin at once find the same one free, and write much later.
  OutputFolder(const UsualFolder& folder, const std::filesystem::path& input);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Without finish() or keep_unfinished(), everything that the run wrote is removed again.
  ~OutputFolder();

  // Where to write a file while the run goes on.
  std::string path(const std::string& file) const { return (unfinished_ / file).string(); }

  // The folder in which files are written while the run goes on.
  std::string unfinished() const { return unfinished_.string(); }

  // The folder as the user named it.
  std::string name() const { return folder_.string(); }

  // Moves what finish() moved up, or began to, down again: of a run that finished, all its results; else these files.
  void take_back(bool finished, const std::vector<std::string>& files);

  // Moves everything up, replacing what an earlier run left; checkpoints only if they are to be kept. A movie, frames
  // or a page that carom view or carom render have made of this run stay, unless it has its own. Throws RunError.
  void finish(bool keep_checkpoints = false);

  // Leaves the files as they are, for inspection of a run that failed. Returns its path.
  std::string keep_unfinished();

  // Takes that back: the files go with this object.
  void discard() { done_ = false; }

 private:
  void begin(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);
  void check_still_free(const std::filesystem::path& name, const std::filesystem::path& input);
  void remove_unfinished() noexcept;
  void lock();

  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  std::vector<std::filesystem::path> made_;  // folders that were not there before, innermost last
  bool done_ = false;
  FolderLock lock_;  // on carom-unfinished
};

// Where a file of a run lies: in folder/carom-unfinished, or in folder if the run finished. One that is in neither
// would lie in carom-unfinished, if there is that.
std::filesystem::path present_path(const std::filesystem::path& folder, const std::string& file);

// Whether a folder holds PNG frames of ours and nothing else, so that it may be replaced as a whole.
bool holds_frames_only(const std::filesystem::path& frames);

// Is a run writing into a folder now?
bool is_being_written(const std::filesystem::path& folder);

// Throws InputError if `folder` cannot take the results of a run on the scene file `input`; changes nothing. To be
// asked early, before anything takes time.
void check_output_folder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);

}  // namespace carom
