// Signals as requests: what arrives during a run is noted and acted on between two steps; a stop also within long ones.
#pragma once

#include <string_view>

namespace carom {

enum class Wish {
  nothing,
  checkpoint,  // SIGUSR1: write one and go on
  stop         // SIGINT, SIGTERM, SIGHUP, SIGXCPU (ulimit -t): write one and stop
};

// From here on the signals above no longer end the process, except a SIGINT after a stop has been requested: it ends
// the process at once. Signals that the caller has ignored stay so (nohup, a shell's background jobs). To be called
// before a run's first step; once more changes nothing.
void catch_signals();

// The strongest request since the last call. A stop stays requested.
Wish take_wish();

// Has a stop been requested? Any thread may call this.
bool stop_wished();

// "SIGTERM", after a stop was requested.
std::string_view stop_signal_name();

}  // namespace carom
