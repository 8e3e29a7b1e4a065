// Ranks that are threads of one process, so that code for MPI can be tested anywhere, and under the thread sanitizer.
#pragma once

#include <functional>

#include "parallel/ranks/ranks.hpp"

namespace carom {

// Runs body(ranks) on `count` threads, each with a rank of its own, and returns when all have ended. If one throws,
// calls of others that would wait for it throw std::runtime_error, and the first exception is thrown here. A thread
// that cannot be started counts as a rank that throws. Precondition: count >= 1.
void run_on_local_ranks(int count, const std::function<void(Ranks&)>& body);

}  // namespace carom
