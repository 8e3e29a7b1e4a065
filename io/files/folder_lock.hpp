// Two programs that write into one folder would spoil each other's files.
#pragma once

#include <filesystem>

namespace carom {

inline constexpr const char* folder_lock_name = "lock";

// Holds a folder by a lock on this file in it: until it is given up, this object goes, or the process ends.
class FolderLock {
 public:
  FolderLock() = default;
  ~FolderLock() { give_up(); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Precondition: it holds none. False where another one has the folder, of this process or of another, or had it and
  // has just taken it away. File systems without locks have none, and let all have it.
  [[nodiscard]] bool take(const std::filesystem::path& folder);
  void give_up();

 private:
  std::filesystem::path file_;  // absolute
  int descriptor_ = -1;         // of file_; -1: nothing is held
};

// Is this folder held now, by this process or by another?
bool is_locked(const std::filesystem::path& folder);

}  // namespace carom
