// Growth of initial states on all cores.
#pragma once

#include "core/start/growth.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// The tools of a growth whose steps and flights use these threads, which the executor has as well. One engine makes all
// flights, so that its neighbour lists last from one to the next, and tell each step which disks are near. The tools
// are for one growth; executor must outlive them.
GrowthTools parallel_growth(const Executor& executor, const Threads& threads);

}  // namespace carom
