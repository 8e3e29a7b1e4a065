#include "parallel/stepping/move_sheared.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/physics/sheared_crossing.hpp"
#include "parallel/stepping/move_kernel.hpp"
#include "parallel/threads/resize_amply.hpp"

namespace carom {

namespace {

// Disks in a block of a single pass.
constexpr std::size_t sheared_block = 8192;

}  // namespace

double move_sheared(Disks& d, const Domain& box, double t, const Executor& executor, ImpactTally& tally,
                    ShearedBlocks& blocks) {
  const std::size_t count = executor.blocks(d.size(), sheared_block);
  assign_amply(blocks.speed2, count, 0.0);
  if (blocks.crossed.size() < count) blocks.crossed.resize(count);
  std::vector<ImpactTally> tallies(count);
  const ShearedMoveKernel kernel = choose_move_kernels().sheared;
  const MoveInput in{d.x.data(), d.y.data(), d.vx.data(), d.vy.data(),
                     nullptr,    nullptr,    box,         t != 0.0 ? Motion::straight : Motion::none,
                     t,          0.0};
  executor.for_ranges(d.size(), sheared_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t>& crossed = blocks.crossed[b];
    crossed.clear();
    double speed2 = kernel(in, begin, end, crossed);
    for (const std::uint32_t i : crossed) {
      cross_sheared(d, i, box, tallies[b]);
      speed2 = std::max(speed2, d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
    }
    blocks.speed2[b] = speed2;
  });
  for (const ImpactTally& block : tallies) tally.add(block);
  double speed2 = 0.0;
  for (const double v2 : blocks.speed2) speed2 = std::max(speed2, v2);
  return speed2;
}

}  // namespace carom
