// A file being written, with every error seen: a full disk shows as an exception, never as a short file.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace carom {

// Writes through a large buffer. Each operation throws RunError, "cannot write PATH: No space left on device".
class OutputFile {
 public:
  // Creates or truncates the file. Children do not inherit the descriptor.
  explicit OutputFile(std::string path);

  // Goes on with a file that is there: cuts it back to its first `bytes` and writes behind them. Throws InputError if
  // it is missing or shorter than that.
  OutputFile(std::string path, std::uint64_t bytes);

  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view text);

  // Hands what is buffered to the system, so that a reader of the growing file sees whole records.
  void flush();

  // Flushes, and returns when the disk itself has everything: from here on not even a power cut takes it away.
  void sync();

  // How long the file is, buffered text included. Known after close() as well.
  std::uint64_t bytes() const { return bytes_; }

  // Flushes and closes. Throws RunError where something is not written; the destructor does not.
  void close();

  const std::string& path() const { return path_; }
  std::string name() const { return path_.substr(path_.rfind('/') + 1); }  // without its folder

 private:
  [[noreturn]] void fail();

  std::string path_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
};

// Throws InputError where path is no file of at least so many bytes (0: where there is nothing); changes nothing.
void check_at_least(const std::string& path, std::uint64_t bytes);

// Returns when a file that another library wrote, or the entries of a folder (new files, new names), are on the disk
// itself. Throws RunError.
void sync_path(const std::string& path);

// The whole text as a file. Throws RunError.
void write_file(const std::string& path, std::string_view text);

// Gives a file another name, in place of the file that had it; devices and pipes, which all programs share, stay.
// Throws RunError, "cannot write TO: why".
void rename_file(const std::string& from, const std::string& to);

// As write_file, by way of PATH.new, so that a failure leaves what was there before. Throws RunError.
void replace_file(const std::string& path, std::string_view text);

}  // namespace carom
