// Where the files of a run go, so that what lies in a folder is always a whole result and never lost by accident.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace carom {

// The files of a run grow in FOLDER/carom-unfinished, where they can be watched, and move up to FOLDER when the run is
// done, summary.json last. Who finds FOLDER/summary.json has a complete result; a run that was killed leaves
// carom-unfinished only.
class OutputFolder {
 public:
  // Makes FOLDER (parents too) and FOLDER/carom-unfinished. Existing results are refused with InputError unless force
  // is set; then they stay until finish() replaces them. input is the scene file: an output never replaces it, force or
  // not. Files that are not Carom's are left alone always. Throws InputError if the folder cannot be made, RunError if
  // only the disk is full.
  OutputFolder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);
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

  // Moves everything up, replacing what an earlier run left. Throws RunError.
  void finish();

  // Leaves the files as they are, for a run that stopped where somebody may want to look. Returns its path.
  std::string keep_unfinished();

 private:
  void remove_unfinished() noexcept;

  std::filesystem::path folder_;
  std::filesystem::path unfinished_;
  std::vector<std::filesystem::path> made_;  // folders that were not there before, innermost last
  bool done_ = false;
};

// Throws InputError if `folder` cannot take the results of a run on the scene file `input`; changes nothing. To be
// asked early, before anything takes time.
void check_output_folder(const std::filesystem::path& folder, const std::filesystem::path& input, bool force);

}  // namespace carom
