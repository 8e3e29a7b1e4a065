#include "app/run/held_signals.hpp"

#include <atomic>

namespace carom {

namespace {

// Variables that a handler uses have to be static, since it is called only with a number.
std::atomic<int> held = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // required in a handler

extern "C" void hold_signal(int signal) {
  held = signal;
}

}  // namespace

HeldSignals::HeldSignals() {
  held = 0;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], nullptr, &before_[k]);
    if (before_[k].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = hold_signal;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    sigaction(signals[k], &action, nullptr);
  }
}

HeldSignals::~HeldSignals() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
  if (held != 0) std::raise(held);
}

void HeldSignals::end_if_asked() {
  if (held != 0) throw HeldSignal();
}

}  // namespace carom
