#include "parallel/exact/window_passes.hpp"

#include <algorithm>

#include "core/disks/disk_view.hpp"
#include "core/physics/wall_overlap.hpp"
#include "core/step/step_start.hpp"
#include "parallel/kicks/draw_velocities.hpp"

namespace carom {

namespace {

// Disks in a block.
constexpr std::size_t pass_disks = 8192;

}  // namespace

SpeedSummary summarise_speeds(const Disks& d, const Domain& box, const Executor& executor) {
  std::vector<SpeedTally> tally(std::max<std::size_t>(executor.blocks(d.size(), pass_disks), 1));
  executor.for_ranges(d.size(), pass_disks,
                      [&](std::size_t b, std::size_t begin, std::size_t end) { tally[b].add(d, box, begin, end); });
  for (std::size_t b = 1; b < tally.size(); ++b) tally[0].add(tally[b]);
  return summarise_speeds(tally[0], d.size());
}

Overlap deepest_wall_overlap(const Disks& d, const Domain& box, const Executor& executor) {
  std::vector<Overlap> deepest(std::max<std::size_t>(executor.blocks(d.size(), pass_disks), 1));
  executor.for_ranges(d.size(), pass_disks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    deepest[b] = deepest_wall_overlap(d, box, begin, end);
  });
  for (std::size_t b = 1; b < deepest.size(); ++b) deepest[0].raise_to(deepest[b]);
  return deepest[0];
}

void draw_brownian_interval(Disks& disks, const Scene& scene, const BrownianInterval& interval,
                            const Executor& executor, std::vector<unsigned char>& gone) {
  const std::size_t n = disks.size();
  const bool sinks = has_brownian_sink(scene);
  gone.assign(sinks ? n : 0, 0);
  std::vector<double> of_blocks;
  draw_velocities(disks, scene, interval.length, interval.number, executor, of_blocks);
  if (!sinks) return;
  with_view(disks, [&](const auto& d) {
    executor.for_ranges(n, pass_disks, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        gone[i] = sink_crossed(d, scene, interval.number, interval.length, i) != no_sink ? 1 : 0;
      }
    });
  });
}

void count_crossed(Disks& disks, const Scene& scene, const BrownianInterval& interval,
                   const std::vector<unsigned char>& gone, std::size_t begin, std::size_t end, SinkCounts& taken) {
  with_view(disks, [&](const auto& d) {
    count_gone(gone, begin, end, taken,
               [&](std::size_t i) { return sink_crossed(d, scene, interval.number, interval.length, i); });
  });
}

}  // namespace carom
