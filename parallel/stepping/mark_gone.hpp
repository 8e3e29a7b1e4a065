// Which disks sinks take, on threads.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/scene/scene.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// gone[i] becomes 1 for each disk i that touches a sink, else 0. Returns how many do, which `taken` counts by sink.
// scratch: any.
Count mark_at_sinks(Disks& disks, const Domain& box, const Executor& executor, std::vector<unsigned char>& gone,
                    SinkCounts& taken, std::vector<double>& scratch);

// Likewise those that cross a sink within Brownian step number `step`, of length dt, unseen at its end.
Count mark_crossing(Disks& disks, const Scene& scene, double dt, Count step, const Executor& executor,
                    std::vector<unsigned char>& gone, SinkCounts& taken, std::vector<double>& scratch);

}  // namespace carom
