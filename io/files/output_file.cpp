#include "io/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/check.hpp"

namespace carom {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;  // large enough that the system call costs nothing
// To reserve less than this takes longer than it saves, and leaves the file in as many pieces as there were requests.
constexpr std::uint64_t least_reserved = std::uint64_t{1} << 20;

// Pipes and some network file systems have no fsync; that is no error.
bool cannot_sync(int error) {
  return error == EINVAL || error == EROFS || error == ENOTSUP;
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "we")) {
  if (file_ == nullptr) fail();
  std::setvbuf(file_, nullptr, _IOFBF, buffer_bytes);
}

OutputFile::OutputFile(std::string path, std::uint64_t bytes) : path_(std::move(path)), bytes_(bytes) {
  check_at_least(path_, bytes);
  file_ = std::fopen(path_.c_str(), "r+e");
  if (file_ == nullptr || ftruncate(fileno(file_), static_cast<off_t>(bytes)) != 0 || fseeko(file_, 0, SEEK_END) != 0) {
    fail();
  }
  std::setvbuf(file_, nullptr, _IOFBF, buffer_bytes);
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
  bytes_ += text.size();
}

void OutputFile::reserve([[maybe_unused]] std::uint64_t bytes) {
  if (bytes < least_reserved) return;
#if defined(FALLOC_FL_KEEP_SIZE)
  // The length stays that of what is written, so that a run that is killed leaves no zeros.
  static_cast<void>(
      fallocate(fileno(file_), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(bytes_), static_cast<off_t>(bytes)));
#endif
}

void OutputFile::flush() {
  if (std::fflush(file_) != 0) fail();
}

void OutputFile::sync() {
  flush();
  if (fsync(fileno(file_)) != 0 && !cannot_sync(errno)) fail();
}

void OutputFile::close() {
  std::FILE* const closing = file_;
  file_ = nullptr;
  if (closing != nullptr && std::fclose(closing) != 0) fail();
}

void OutputFile::fail() {
  throw RunError(fmt::format("cannot write {}: {}", path_, std::strerror(errno)));
}

void write_file(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

void rename_file(const std::string& from, const std::string& to) {
  std::error_code none;
  const std::filesystem::file_status there = std::filesystem::status(to, none);
  if (std::filesystem::is_other(there)) throw RunError(fmt::format("cannot write {}: it is a device or a pipe", to));
  if (std::rename(from.c_str(), to.c_str()) == 0) return;
  throw RunError(fmt::format("cannot write {}: {}", to, std::strerror(errno)));
}

void replace_file(const std::string& path, std::string_view text) {
  const std::string beside = path + ".new";
  try {
    write_file(beside, text);
    rename_file(beside, path);
  } catch (const RunError&) {
    std::remove(beside.c_str());  // a full disk needs the room
    throw;
  }
}

void check_at_least(const std::string& path, std::uint64_t bytes) {
  std::error_code error;
  if (bytes == 0 && std::filesystem::exists(path, error)) return;  // a folder, too
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) {
    throw InputError(fmt::format("{}: {}; expected the file that the resumed run continues", path, error.message()));
  }
  if (size >= bytes) return;
  throw InputError(
      fmt::format("{}: has {} bytes; expected {} or more, as when the checkpoint was made", path, size, bytes));
}

void sync_path(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && (fsync(descriptor) == 0 || cannot_sync(errno));
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done) throw RunError(fmt::format("cannot write {}: {}", path, std::strerror(error)));
}

}  // namespace carom
