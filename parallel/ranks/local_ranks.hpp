// Ranks that are threads of one process: what runs over MPI can be tested anywhere, and under the thread sanitizer.
#pragma once

#include <functional>

#include "parallel/ranks/ranks.hpp"

namespace carom {

// Runs body(ranks) on `count` threads, each with a rank of its own, and returns when all have ended. Where one of them
// throws, calls of the others that would wait for it throw std::runtime_error; the exception of the rank that threw
// first is thrown here. A thread that cannot be started is a rank that throws. Precondition: count >= 1.
void run_on_local_ranks(int count, const std::function<void(Ranks&)>& body);

}  // namespace carom
