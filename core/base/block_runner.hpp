// Work cut into numbered blocks, which the caller runs on the threads that it has.
#pragma once

#include <cstddef>
#include <functional>

namespace carom {

using BlockTask = std::function<void(std::size_t)>;

// Calls task(b) once for every b below blocks, perhaps several at the same time and in any order, and returns when all
// are done. An exception that a task throws is thrown on to the caller.
using BlockRunner = std::function<void(std::size_t blocks, const BlockTask& task)>;

inline void run_in_order(std::size_t blocks, const BlockTask& task) {
  for (std::size_t b = 0; b < blocks; ++b) task(b);
}

}  // namespace carom
