// Marks the disks that sinks take, in parallel.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/scene/scene.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Sets gone[i] to 1 for each disk i that touches a sink, else to 0. Returns their number, and adds it to `taken` by
// sink. scratch: any vector.
Count mark_at_sinks(Disks& disks, const Domain& box, const Executor& executor, std::vector<unsigned char>& gone,
                    SinkCounts& taken, std::vector<double>& scratch);

// The same for disks that cross a sink within Brownian step number `step`, of length dt, but lie inside at its end.
Count mark_crossing(Disks& disks, const Scene& scene, double dt, Count step, const Executor& executor,
                    std::vector<unsigned char>& gone, SinkCounts& taken, std::vector<double>& scratch);

}  // namespace carom
