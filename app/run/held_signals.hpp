// Signals that end the program wait while there are files that nothing else would take away.
#pragma once

#include <array>
#include <csignal>
#include <exception>

namespace carom {

// From construction to destruction SIGINT, SIGTERM and SIGHUP are only noted; a second one ends the program at once.
// What has come does at the end what it would have done. One at a time.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  // Throws HeldSignal where one has come, so that what is there goes away now.
  static void end_if_asked();

 private:
  static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, signals.size()> before_{};
};

// On its way out of the HeldSignals, which end the program then.
struct HeldSignal : std::exception {
  const char* what() const noexcept override { return "ended by a signal"; }
};

}  // namespace carom
