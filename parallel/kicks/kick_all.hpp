// The kicks of a thermostat, shared out among threads.
#pragma once

#include <cstddef>

#include "core/base/exact_sum.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Disks a block.
inline constexpr std::size_t kick_block = 4096;

// Does what core/step/thermostat.hpp does if a kick is due, with the same bits. Returns whether it was.
bool kick_if_due(const Scene& scene, State& state, const Executor& executor);

// Kick number `number` for disks [begin, end); the energy that it gives them is added to heat.
void kick_range(Disks& disks, const Scene& scene, Count number, std::size_t begin, std::size_t end, ExactSum& heat);

// The same for all these disks; returns the energy that it gave them.
ExactSum kick_all(Disks& disks, const Scene& scene, Count number, const Executor& executor);

}  // namespace carom
