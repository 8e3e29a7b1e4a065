#include "parallel/cells/kick_all.hpp"

#include <vector>

#include "core/step/thermostat.hpp"

namespace carom {

namespace {

// Disks a block.
constexpr std::size_t kick_block = 4096;

}  // namespace

bool kick_if_due(const Scene& scene, State& state, const Executor& executor) {
  if (!is_kick_due(scene, state)) return false;
  const Count number = state.intervals++;
  const std::size_t n = state.disks.size();
  std::vector<ExactSum> heat(executor.blocks(n, kick_block) + 1);
  with_view(state.disks, [&](const auto& d) {
    executor.for_ranges(n, kick_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      kick_disks(d, scene, number, begin, end, heat[b]);
    });
  });
  for (std::size_t b = 1; b < heat.size(); ++b) heat[0].add(heat[b]);
  state.counters.thermostat_heat += heat[0].value();
  return true;
}

}  // namespace carom
