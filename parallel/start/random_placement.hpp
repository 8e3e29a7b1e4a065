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

// What core's place_at_random gives, bit for bit, on any number of threads. watch is called between batches of disks
// and may be empty; what it throws ends the placing.
void parallel_place_at_random(const Executor& executor, const Scene& scene, Disks& disks, PlacementGrid& grid,
                              std::vector<std::uint32_t> members, const std::function<void()>& watch = {});

// initial_state of core, with this placing and growth on as many threads. watch is told how placing and growth go on,
// and may be empty; what it throws ends them. threads >= 1.
State parallel_initial_state(const Scene& scene, int threads,
                             const std::function<void(const GrowthProgress&)>& watch = {});

}  // namespace carom
