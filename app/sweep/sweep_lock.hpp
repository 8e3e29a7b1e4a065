// Two sweeps in one folder would take each other's runs for failures, or delete them.
#pragma once

#include <filesystem>

namespace carom {

// Holds a folder that exists for as long as it lives; it goes with the process. File systems without locks have none.
// The folder itself is locked: FolderLock would leave a file among the results of the sweep.
class SweepLock {
 public:
  // Throws InputError where another process holds the folder.
  explicit SweepLock(const std::filesystem::path& folder);
  ~SweepLock();
  SweepLock(const SweepLock&) = delete;
  SweepLock& operator=(const SweepLock&) = delete;

 private:
  int folder_ = -1;  // descriptor
};

}  // namespace carom
