// Runs many programs, a few at a time, watched from one thread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "io/files/child_process.hpp"

namespace carom {

struct Programs {
  std::size_t count = 0;
  std::size_t at_once = 1;
  std::function<std::unique_ptr<ChildProcess>(std::size_t)> start;  // starts the k-th program; null if that fails
  std::function<void(std::size_t, int)> ended;  // called when the k-th program has ended, with its exit status
  std::function<void(std::size_t)> pulse;  // called several times a second, with the number of programs that have ended
};

// Runs them all. Signals are those of stop_signals.hpp, whose catch_signals() must have been called: a stop is passed
// on to the running programs, and no other is started. Returns false if that happened.
bool run_programs(const Programs& programs);

}  // namespace carom
