#include "parallel/stepping/move_sheared.hpp"

#include <algorithm>
#include <cstddef>

#include "core/physics/advance.hpp"
#include "core/physics/sheared_crossing.hpp"

namespace carom {

namespace {

// Disks a block: each is looked at once.
constexpr std::size_t sheared_block = 8192;

}  // namespace

double move_sheared(Disks& d, const Domain& box, double t, const Executor& executor, ImpactTally& tally,
                    std::vector<double>& block_values) {
  block_values.assign(executor.blocks(d.size(), sheared_block), 0.0);
  std::vector<ImpactTally> tallies(block_values.size());
  executor.for_ranges(d.size(), sheared_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    double speed2 = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (t != 0.0) drift<false>(d.x[i], d.y[i], d.vx[i], d.vy[i], t, 0.0);
      cross_sheared(d, i, box, tallies[b]);
      speed2 = std::max(speed2, d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
    }
    block_values[b] = speed2;
  });
  for (const ImpactTally& block : tallies) tally.add(block);
  double speed2 = 0.0;
  for (const double v2 : block_values) speed2 = std::max(speed2, v2);
  return speed2;
}

}  // namespace carom
