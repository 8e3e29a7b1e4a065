#include "parallel/stepping/mark_gone.hpp"

#include "core/disks/disk_view.hpp"
#include "core/step/step_start.hpp"

namespace carom {

namespace {

// Disks in a block.
constexpr std::size_t mark_block = 8192;

// sink_of(view, i): the sink that takes disk i, or no_sink. The counts of blocks are whole numbers below 2^53, so their
// sum is exact.
template <class SinkOf>
Count mark(Disks& disks, const Executor& executor, std::vector<unsigned char>& gone, SinkCounts& taken,
           std::vector<double>& scratch, SinkOf&& sink_of) {
  const std::size_t n = disks.size();
  gone.resize(n);
  scratch.assign(executor.blocks(n, mark_block), 0.0);
  with_view(disks, [&](const auto& d) {
    executor.for_ranges(n, mark_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        gone[i] = sink_of(d, i) != no_sink ? 1 : 0;
        scratch[b] += gone[i];
      }
    });
  });
  double marked = 0.0;
  for (const double count : scratch) marked += count;
  if (marked > 0.0) {
    with_view(disks,
              [&](const auto& d) { count_gone(gone, 0, n, taken, [&](std::size_t i) { return sink_of(d, i); }); });
  }
  return static_cast<Count>(marked);
}

}  // namespace

Count mark_at_sinks(Disks& disks, const Domain& box, const Executor& executor, std::vector<unsigned char>& gone,
                    SinkCounts& taken, std::vector<double>& scratch) {
  // For disks that are clear of all obstacles, only sides are sinks.
  Domain sides = box;
  sides.obstacles = nullptr;
  const bool inner = box.obstacles != nullptr && box.obstacles->has_sinks();
  return mark(disks, executor, gone, taken, scratch, [&](const auto& d, std::size_t i) {
    const bool may_touch_inner = inner && d.radius(i) > box.obstacles->clearance({d.x[i], d.y[i]});
    return sink_touched(d, may_touch_inner ? box : sides, i);
  });
}

Count mark_crossing(Disks& disks, const Scene& scene, double dt, Count step, const Executor& executor,
                    std::vector<unsigned char>& gone, SinkCounts& taken, std::vector<double>& scratch) {
  return mark(disks, executor, gone, taken, scratch,
              [&](const auto& d, std::size_t i) { return sink_crossed(d, scene, step, dt, i); });
}

}  // namespace carom
