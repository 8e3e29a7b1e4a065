// A file being written, with every error seen: a full disk shows as an exception, never as a short file.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace carom {

// Writes through a large buffer. Each operation throws RunError, "cannot write PATH: No space left on device".
class OutputFile {
 public:
  // Creates or truncates the file. Children do not inherit the descriptor.
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view text);

  // Hands what is buffered to the system, so that somebody who watches the file sees whole records.
  void flush();

  // Flushes and closes. To be called by whoever wants to know that all is written; the destructor stays silent.
  void close();

  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail();

  std::string path_;
  std::FILE* file_ = nullptr;
};

// The whole text as a file. Throws RunError.
void write_file(const std::string& path, std::string_view text);

}  // namespace carom
