// A lock against two sweeps in one folder, which would take each other's runs for failures, or delete them.
#pragma once

#include <filesystem>

namespace carom {

// Locks an existing folder during its lifetime, or until the process ends. File systems without locks have none. The
// folder itself is locked, since FolderLock would leave a file among the results of the sweep.
class SweepLock {
 public:
  // Throws InputError if another process has locked the folder.
  explicit SweepLock(const std::filesystem::path& folder);
  ~SweepLock();
  SweepLock(const SweepLock&) = delete;
  SweepLock& operator=(const SweepLock&) = delete;

 private:
  int folder_ = -1;  // descriptor
};

}  // namespace carom
