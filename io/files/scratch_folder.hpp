// A temporary folder.
#pragma once

#include <filesystem>

namespace carom {

// A new folder, which is removed with all its files when this object is destroyed.
class ScratchFolder {
 public:
  // Makes a new folder parent/name-XXXXXX, with six random letters. Throws RunError if that fails.
  ScratchFolder(const std::filesystem::path& parent, const char* name);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }  // absolute

 private:
  std::filesystem::path path_;
};

}  // namespace carom
