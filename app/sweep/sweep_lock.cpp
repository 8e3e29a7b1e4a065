#include "app/sweep/sweep_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "core/base/input_message.hpp"

namespace carom {

SweepLock::SweepLock(const std::filesystem::path& folder) : folder_(::open(folder.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (folder_ < 0 || flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(folder_);
  fail_input(folder.string(), "another sweep is running there", "expected another folder (-o)");
}

SweepLock::~SweepLock() {
  if (folder_ >= 0) ::close(folder_);
}

}  // namespace carom
