// Signals that end the program wait while there are files that nothing else would remove.
#pragma once

#include <array>
#include <csignal>
#include <exception>

namespace carom {

// From construction to destruction SIGINT, SIGTERM and SIGHUP are only noted; a second one ends the program at once.
// The destructor raises a noted signal again. Only one object may exist at a time.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  // Throws HeldSignal if a signal has come, so that the present files are removed now.
  static void end_if_asked();

 private:
  static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, signals.size()> before_{};
};

// Unwinds to the HeldSignals, which then end the program.
struct HeldSignal : std::exception {
  const char* what() const noexcept override { return "ended by a signal"; }
};

}  // namespace carom
