// Signals as requests: a signal during a run is noted and acted on between two steps; a stop also within long steps.
#pragma once

#include <string_view>

namespace carom {

enum class Wish {
  nothing,
  checkpoint,  // SIGUSR1: write one and go on
  stop         // SIGINT, SIGTERM, SIGHUP, SIGXCPU (ulimit -t): write one and stop
};

// From here on the signals above no longer end the process; but a SIGINT after a stop has been requested ends it at
// once. Signals that the caller ignores stay ignored (nohup, background jobs of a shell). To be called before a run's
// first step; further calls change nothing.
void catch_signals();

// The strongest request since the last call. A stop stays requested.
Wish take_wish();

// Has a stop been requested? Any thread may call this.
bool stop_wished();

// "SIGTERM", after a stop was requested.
std::string_view stop_signal_name();

}  // namespace carom
