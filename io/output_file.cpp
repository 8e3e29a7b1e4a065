#include "io/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "core/check.hpp"

namespace carom {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;  // large enough that the system call costs nothing

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "we")) {
  if (file_ == nullptr) fail();
  std::setvbuf(file_, nullptr, _IOFBF, buffer_bytes);
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void OutputFile::flush() {
  if (std::fflush(file_) != 0) fail();
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

}  // namespace carom
