// Growth of initial states on all cores.
#pragma once

#include <vector>

#include "core/start/growth.hpp"
#include "parallel/threads/executor.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// What core's grow_step gives, bit for bit, on any number of threads; the disks end up in the order of their cells.
GrowthTally parallel_grow_step(const Executor& executor, Disks& disks, const Domain& box,
                               const std::vector<double>& target);

// The tools of a growth whose steps and flights use these threads, which the executor has as well. executor must
// outlive them.
GrowthTools parallel_growth(const Executor& executor, const Threads& threads);

}  // namespace carom
