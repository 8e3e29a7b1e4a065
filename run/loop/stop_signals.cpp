#include "run/loop/stop_signals.hpp"

#include <atomic>
#include <csignal>

namespace carom {

namespace {

// The data of a signal handler have to be static: it is called with a number and nothing else.
std::atomic<int> stop_signal = 0;
std::atomic<int> checkpoint_wanted = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // as a handler needs

extern "C" void note_signal(int signal) {
  if (signal == SIGUSR1) {
    checkpoint_wanted = 1;
    return;
  }
  if (signal == SIGINT && stop_signal != 0) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
    return;
  }
  stop_signal = signal;
}

}  // namespace

void catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;  // a write in progress is not interrupted
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

Wish take_wish() {
  if (stop_signal != 0) return Wish::stop;
  if (checkpoint_wanted == 0) return Wish::nothing;
  checkpoint_wanted = 0;
  return Wish::checkpoint;
}

bool stop_wished() {
  return stop_signal != 0;
}

std::string_view stop_signal_name() {
  switch (stop_signal) {
    case SIGINT:
      return "SIGINT";
    case SIGHUP:
      return "SIGHUP";
    case SIGXCPU:
      return "SIGXCPU";
    default:
      return "SIGTERM";
  }
}

}  // namespace carom
