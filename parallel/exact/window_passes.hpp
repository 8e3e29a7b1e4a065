// Passes over all disks between two windows, on threads; each disk is treated by itself.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/overlap.hpp"
#include "core/disks/sink_counts.hpp"
#include "core/scene/scene.hpp"
#include "core/step/window_length.hpp"
#include "core/step/window_start.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

SpeedSummary summarise_speeds(const Disks& disks, const Domain& box, const Executor& executor);

// The deepest reach of any disk beyond a wall or into an obstacle (core/physics/wall_overlap.hpp); size 0 if none.
Overlap deepest_wall_overlap(const Disks& disks, const Domain& box, const Executor& executor);

// Draws the velocities of a Brownian interval. If a sink removes disks that cross it without being seen, gone has an
// entry for each disk, 1 for these; otherwise it is empty.
void draw_brownian_interval(Disks& disks, const Scene& scene, const BrownianInterval& interval,
                            const Executor& executor, std::vector<unsigned char>& gone);

// Counts the disks from begin to before end that it marked, by the sinks that they cross.
void count_crossed(Disks& disks, const Scene& scene, const BrownianInterval& interval,
                   const std::vector<unsigned char>& gone, std::size_t begin, std::size_t end, SinkCounts& taken);

}  // namespace carom
