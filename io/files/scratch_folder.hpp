// A folder for files that nobody keeps.
#pragma once

#include <filesystem>

namespace carom {

// A new folder, which goes away with this object and with everything in it.
class ScratchFolder {
 public:
  // Makes parent/name-XXXXXX, the six letters such that there was none. Throws RunError where that cannot be done.
  ScratchFolder(const std::filesystem::path& parent, const char* name);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }  // absolute

 private:
  std::filesystem::path path_;
};

}  // namespace carom
