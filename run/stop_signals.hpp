// Signals as wishes: what arrives while a run goes on is noted, and asked for between two steps and, a stop, within
// long ones.
#pragma once

#include <string_view>

namespace carom {

enum class Wish {
  nothing,
  checkpoint,  // SIGUSR1: write one and go on
  stop         // SIGINT, SIGTERM, SIGHUP: write one and stop
};

// From here on the signals above no longer end the process, but for a SIGINT that comes when a stop is wished for
// already: somebody does not want to wait. Signals that the caller has ignored stay so (nohup, a shell's background
// jobs). To be called once, before a run's first step.
void catch_signals();

// The strongest wish since the last call. A stop stays a wish.
Wish take_wish();

// Is a stop wished for? Any thread may ask.
bool stop_wished();

// "SIGTERM", after a wish to stop.
std::string_view stop_signal_name();

}  // namespace carom
