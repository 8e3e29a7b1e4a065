// The kicks of a thermostat, in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/exact_sum.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Disks a block.
inline constexpr std::size_t kick_block = 4096;

// kick_if_due of core/step/thermostat.hpp, with the same bits. Returns whether a kick was due. kicked: if not null, the
// disks that were kicked are added to it.
bool kick_if_due(const Scene& scene, State& state, const Executor& executor,
                 std::vector<std::uint32_t>* kicked = nullptr);

// Kick number `number` for disks [begin, end); adds the energy that it gives them to heat. kicked: as above.
void kick_range(Disks& disks, const Scene& scene, Count number, std::size_t begin, std::size_t end, ExactSum& heat,
                std::vector<std::uint32_t>* kicked = nullptr);

// The same for all disks; returns the energy that it gave them.
ExactSum kick_all(Disks& disks, const Scene& scene, Count number, const Executor& executor,
                  std::vector<std::uint32_t>* kicked = nullptr);

}  // namespace carom
