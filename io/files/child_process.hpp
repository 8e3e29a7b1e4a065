// Running gnuplot, ffmpeg and the runs of a sweep: started directly with a list of arguments, never through a shell.
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

// To be called first thing by a program that may have been started by a ChildProcess with ChildSignals::reach_it: when
// that process ends, however it does, SIGTERM comes. Does nothing for others.
void end_with_parent();

// Does a signal that is sent to the child itself reach it, or are those that ask it to stop held back? Batch systems
// send them to every process of a job: we stop in order then, and need an encoder to the end.
enum class ChildSignals : std::uint8_t { held_back, reach_it };

// A program that runs beside us, fed through its standard input. What it says goes to a log file.
class ChildProcess {
 public:
  // arguments[0] is the program's path. Its output and error output are written to log_path. It runs in `folder` and
  // in a process group of its own, so that Ctrl-C on a terminal reaches us only and the child ends when we say so.
  // SIGPIPE is ignored from here on in the whole process: a child that dies shows as an error of write().
  // Throws RunError if it cannot be started.
  ChildProcess(const std::vector<std::string>& arguments, const std::string& folder, const std::string& log_path,
               ChildSignals signals = ChildSignals::held_back);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // A child still running is killed: its output is not wanted any more.
  ~ChildProcess();

  // Returns false when the child has stopped listening.
  bool write(const void* data, std::size_t bytes);

  // Nothing more will be written: where the child reads it finds the end.
  void close_input();

  // Closes the child's input and waits for it; returns its exit status, or 128 + signal.
  int wait();

  // The same once it has ended; nothing, at once, while it runs.
  std::optional<int> poll();

  // Sends it a signal, if it still runs.
  void tell(int signal) const;

 private:
  pid_t pid_ = -1;
  int input_ = -1;
};

// Last non-empty line of a log file, for a one-line message; empty if there is none.
std::string last_line(const std::string& log_path);

}  // namespace carom
