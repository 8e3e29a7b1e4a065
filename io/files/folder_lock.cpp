#include "io/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <utility>
#include <vector>

namespace carom {

namespace fs = std::filesystem;

namespace {

// The files that this process has locked. A record lock belongs to the process, so no child inherits it, and it ends
// with the process in any case. The process also loses it by closing any descriptor of the file; this list keeps it
// from opening a second one. A mutex protects the list, since a program may run scenes on several threads.
struct LocksHeld {
  std::mutex mutex;
  std::vector<fs::path> files;

  // Precondition: the mutex is held.
  bool has(const fs::path& file) const {
    std::error_code error;
    return std::any_of(files.begin(), files.end(),
                       [&](const fs::path& held) { return fs::equivalent(held, file, error); });
  }
};

LocksHeld& locks_held() {
  static LocksHeld held;
  return held;
}

struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

// Is the file of this descriptor still there? Another run that ends may take its folder away, with the file in it,
// just before it is locked.
bool is_there(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat present {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &present) == 0 && opened.st_ino == present.st_ino &&
         opened.st_dev == present.st_dev;
}

}  // namespace

bool FolderLock::take(const fs::path& folder) {
  const fs::path file = folder / folder_lock_name;
  LocksHeld& held = locks_held();
  const std::lock_guard guard(held.mutex);
  if (held.has(file)) return false;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return errno != ENOENT;
  struct flock lock = whole_file();
  const bool is_held = fcntl(descriptor, F_SETLK, &lock) != 0 && (errno == EACCES || errno == EAGAIN);
  if (is_held || !is_there(descriptor, file)) {
    ::close(descriptor);
    return false;
  }
  file_ = fs::absolute(file);
  descriptor_ = descriptor;
  held.files.push_back(file_);
  return true;
}

void FolderLock::give_up() {
  if (descriptor_ < 0) return;
  LocksHeld& held = locks_held();
  const std::lock_guard guard(held.mutex);
  std::erase(held.files, file_);
  ::close(std::exchange(descriptor_, -1));
}

bool is_locked(const fs::path& folder) {
  const fs::path file = folder / folder_lock_name;
  LocksHeld& held = locks_held();
  const std::lock_guard guard(held.mutex);
  if (held.has(file)) return true;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = whole_file();
  const bool is_held = fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return is_held;
}

}  // namespace carom
