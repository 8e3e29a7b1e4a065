// Many programs one after the other, some at once, watched from one thread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "io/files/child_process.hpp"

namespace carom {

struct Programs {
  std::size_t count = 0;
  std::size_t at_once = 1;
  std::function<std::unique_ptr<ChildProcess>(std::size_t)> start;  // the k-th; null if it could not be started
  std::function<void(std::size_t, int)> ended;                      // the k-th, with this exit status
  std::function<void(std::size_t)> pulse;                           // several times a second: so many have ended
};

// Runs them all. Signals are those of stop_signals.hpp, whose catch_signals() has been called: a stop is passed on to
// those that run, and no other is started. Returns false if that happened.
bool run_programs(const Programs& programs);

}  // namespace carom
