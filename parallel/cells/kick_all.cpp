#include "parallel/cells/kick_all.hpp"

#include <vector>

#include "core/step/thermostat.hpp"

namespace carom {

ExactSum kick_all(Disks& disks, const Scene& scene, Count number, const Executor& executor) {
  const std::size_t n = disks.size();
  std::vector<ExactSum> heat(executor.blocks(n, kick_block) + 1);
  with_view(disks, [&](const auto& d) {
    executor.for_ranges(n, kick_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      kick_disks(d, scene, number, begin, end, heat[b]);
    });
  });
  for (std::size_t b = 1; b < heat.size(); ++b) heat[0].add(heat[b]);
  return heat[0];
}

bool kick_if_due(const Scene& scene, State& state, const Executor& executor) {
  if (!is_kick_due(scene, state)) return false;
  const Count number = state.intervals++;
  state.counters.thermostat_heat += kick_all(state.disks, scene, number, executor).value();
  return true;
}

}  // namespace carom
