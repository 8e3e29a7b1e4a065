// Work in numbered blocks, to be shared out by the caller, whatever threads it has.
#pragma once

#include <cstddef>
#include <functional>

namespace carom {

using BlockTask = std::function<void(std::size_t)>;

// Calls task(b) once for every b below blocks, perhaps several at the same time and in any order, and returns when all
// are done. What a task throws comes out.
using BlockRunner = std::function<void(std::size_t blocks, const BlockTask& task)>;

inline void run_in_order(std::size_t blocks, const BlockTask& task) {
  for (std::size_t b = 0; b < blocks; ++b) task(b);
}

}  // namespace carom
