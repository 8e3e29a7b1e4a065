// Locks a folder, so that no two programs write into it.
#pragma once

#include <filesystem>

namespace carom {

inline constexpr const char* folder_lock_name = "lock";

// A lock on a file in the folder, held until it is released, this object is destroyed, or the process ends.
class FolderLock {
 public:
  FolderLock() = default;
  ~FolderLock() { give_up(); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Returns false if another object, of this or another process, has the folder, or had it and has just taken it away.
  // On file systems without locks always true. Precondition: this object holds no folder.
  [[nodiscard]] bool take(const std::filesystem::path& folder);
  void give_up();

 private:
  std::filesystem::path file_;  // absolute
  int descriptor_ = -1;         // of file_; -1: nothing is held
};

// Is this folder locked now, by this process or another?
bool is_locked(const std::filesystem::path& folder);

}  // namespace carom
