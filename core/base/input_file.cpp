#include "core/base/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/base/input_message.hpp"
#include "core/base/machine_memory.hpp"

namespace carom {

namespace {

constexpr double gigabyte = 1e9;
constexpr std::string_view expected = "expected a file that can be read";

// Closes itself.
struct Descriptor {
  explicit Descriptor(int n) : number(n) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  int number;
};

// What messages call a file that is not regular.
std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "is a directory";
  if (S_ISFIFO(mode)) return "is a FIFO";
  if (S_ISSOCK(mode)) return "is a socket";
  return "is a device";
}

// Does the path name a stream that the caller has opened for this process, as a shell's <(...) does?
bool is_of_this_process(std::string_view path) {
  return path == "/dev/stdin" || path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/");
}

bool is_open_stream(std::string_view path, mode_t mode) {
  return is_of_this_process(path) && (S_ISFIFO(mode) || S_ISSOCK(mode) || S_ISCHR(mode));
}

std::string system_text(int error) {
  return std::generic_category().message(error);
}

}  // namespace

std::string read_text_file(const std::string& path, std::string_view where) {
  // Without O_NONBLOCK the call would wait for the other end of a FIFO.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number < 0) {
    const int error = errno;
    struct stat status {};
    // A socket cannot be opened at all.
    if (::stat(path.c_str(), &status) == 0 && S_ISSOCK(status.st_mode)) fail_input(where, "is a socket", expected);
    fail_input(where, fmt::format("cannot be opened: {}", system_text(error)), expected);
  }
  struct stat status {};
  if (::fstat(file.number, &status) != 0) fail_input(where, "cannot be read", expected);
  const bool stream = is_open_stream(path, status.st_mode);
  if (S_ISDIR(status.st_mode)) fail_input(where, kind_of(status.st_mode), "expected a file");
  if (!S_ISREG(status.st_mode) && !stream) {
    fail_input(where, fmt::format("{}, which may never end", kind_of(status.st_mode)), "expected a regular file");
  }
  const double most = stream ? gigabyte : machine_memory();
  const auto check_size = [&](double bytes) {
    if (bytes <= most) return;
    fail_input(where, fmt::format("is larger than {:.3g} GB", most / gigabyte), "expected a smaller file");
  };
  check_size(static_cast<double>(status.st_size));
  ::fcntl(file.number, F_SETFL, ::fcntl(file.number, F_GETFL) & ~O_NONBLOCK);
  std::string text;
  text.reserve(static_cast<std::size_t>(std::max<off_t>(0, status.st_size)));
  std::array<char, 1 << 16> block{};
  for (;;) {
    const ssize_t n = ::read(file.number, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_input(where, fmt::format("cannot be read: {}", system_text(errno)), expected);
    if (n == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(n));
    check_size(static_cast<double>(text.size()));
  }
}

void check_other_processes_have(const std::string& path) {
  if (is_of_this_process(path)) fail_input(path, "cannot be read by several processes", "expected the name of a file");
}

void check_regular_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  fail_input(path, kind_of(status.st_mode), "expected a regular file");
}

}  // namespace carom
