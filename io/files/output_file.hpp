// A file to be written, with every error checked: a full disk gives an exception, never a short file.
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

  // Continues an existing file: cuts it to its first `bytes` bytes and writes after them. Throws InputError if it is
  // missing or shorter than that.
  OutputFile(std::string path, std::uint64_t bytes);

  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view text);

  // Asks the file system for room behind what is written, before that much is written: to find it at once takes half
  // the time of the system's writes. Of less than a megabyte no room is asked for: it would take longer. A file system
  // that cannot do so, or is full, is no error here.
  void reserve(std::uint64_t bytes);

  // Passes buffered data to the system, so that readers of the growing file see whole records.
  void flush();

  // Flushes, and returns when all data are on the disk and survive a power cut.
  void sync();

  // The length of the file, including buffered data; also valid after close().
  std::uint64_t bytes() const { return bytes_; }

  // Flushes and closes. Throws RunError if data cannot be written; the destructor does not throw.
  void close();

  const std::string& path() const { return path_; }
  std::string name() const { return path_.substr(path_.rfind('/') + 1); }  // without its folder

 private:
  [[noreturn]] void fail();

  std::string path_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
};

// Throws InputError unless path is a file of at least this number of bytes (0: any existing path). Changes nothing.
void check_at_least(const std::string& path, std::uint64_t bytes);

// Returns when a file that another library wrote, or the entries of a folder (new files, new names), are on the disk.
// Throws RunError.
void sync_path(const std::string& path);

// Writes the text as a file. Throws RunError.
void write_file(const std::string& path, std::string_view text);

// Renames a file, and replaces an existing file of that name, but never a device or a pipe. Throws RunError, "cannot
// write TO: why".
void rename_file(const std::string& from, const std::string& to);

// As write_file, through PATH.new, so that a failure leaves an existing file unchanged. Throws RunError.
void replace_file(const std::string& path, std::string_view text);

}  // namespace carom
