// Growth of initial states on all cores.
#pragma once

#include "core/start/growth.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The tools of a growth whose steps and flights use these threads, which are also the executor's. One engine makes all
// flights, so its neighbour lists last from one flight to the next, and give each step the disks near each other. The
// tools are for one growth; executor must outlive them.
GrowthTools parallel_growth(const Executor& executor, const Threads& threads);

}  // namespace carom
