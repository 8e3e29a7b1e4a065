// Random sequential addition on all cores.
#pragma once

#include <functional>

#include "core/disks/disks.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "core/start/growth.hpp"
#include "core/start/placement_grid.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// place_at_random of core, with the same bits on any number of threads. watch, if not empty, is called between batches
// of disks; an exception thrown by it ends the placing.
void parallel_place_at_random(const Executor& executor, const Scene& scene, Disks& disks, PlacementGrid& grid,
                              std::vector<std::uint32_t> members, const std::function<void()>& watch = {});

// initial_state of core, with placing and growth on `threads` (>= 1) threads. watch, if not empty, is called with the
// progress of placing and growth; an exception thrown by it ends them.
State parallel_initial_state(const Scene& scene, int threads,
                             const std::function<void(const GrowthProgress&)>& watch = {});

}  // namespace carom
