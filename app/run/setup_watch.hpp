// Signals and the wall time while the initial state is made, which no step interrupts.
#pragma once

#include <thread>

#include "core/base/wall_clock.hpp"

namespace carom {

// From its construction on, a separate thread ends the process at SIGINT, SIGTERM, SIGHUP, SIGXCPU and at the end of
// the wall time, with one line and status 4; for SIGUSR1 it prints that there is no checkpoint yet. Signals are those
// of stop_signals.hpp, whose catch_signals() must have been called. The object must be destroyed before anything is
// written.
class SetupWatch {
 public:
  // The process began at `started` and may take max_walltime seconds.
  SetupWatch(WallClock::time_point started, double max_walltime);
  SetupWatch(const SetupWatch&) = delete;
  SetupWatch& operator=(const SetupWatch&) = delete;
  ~SetupWatch();

 private:
  std::jthread thread_;
};

}  // namespace carom
