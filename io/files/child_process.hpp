// Child processes: gnuplot, ffmpeg and the runs of a sweep, started directly with a list of arguments, never through a
// shell.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

// Full path of an executable on PATH, empty if there is none.
std::string find_program(const std::string& name);

// For a program that may be started by a ChildProcess with ChildSignals::reach_it, to be called first: from then on it
// gets SIGTERM when its parent ends in any way. Does nothing in other programs.
void end_with_parent();

// Do signals that ask a process to stop reach the child, or are they held back? Batch systems send them to every
// process of a job; the run then stops in an orderly way, and needs its encoder to the end.
enum class ChildSignals : std::uint8_t { held_back, reach_it };

// A child process, fed through its standard input, whose output goes to a log file.
class ChildProcess {
 public:
  // arguments[0] is the program's path. Its output and error output are written to log_path. It runs in `folder` and in
  // a process group of its own, so that Ctrl-C on a terminal reaches only the parent. From here on this process ignores
  // SIGPIPE: if the child dies, write() returns an error. Throws RunError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::string& folder, const std::string& log_path,
               ChildSignals signals = ChildSignals::held_back);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Kills the child if it still runs.
  ~ChildProcess();

  // Returns false if the child no longer reads.
  bool write(const void* data, std::size_t bytes);

  // Closes the child's standard input.
  void close_input();

  // Closes the child's input and waits for it; returns its exit status, or 128 + signal.
  int wait();

  // The exit status if the child has ended; nothing while it runs. Does not wait.
  std::optional<int> poll();

  // Sends the child a signal, if it still runs.
  void tell(int signal) const;

 private:
  pid_t pid_ = -1;
  int input_ = -1;
};

// The last non-empty line of a log file, for messages; empty if there is none.
std::string last_line(const std::string& log_path);

}  // namespace carom
