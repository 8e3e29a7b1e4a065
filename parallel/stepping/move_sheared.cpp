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
    double* const x = d.x.data();
    double* const y = d.y.data();
    double* const vx = d.vx.data();
    double* const vy = d.vy.data();
    for (std::size_t i = begin; i < end; ++i) {
      if (t != 0.0) drift<false>(x[i], y[i], vx[i], vy[i], t, 0.0);
      const bool in_box = x[i] >= 0.0 && x[i] < box.width && y[i] >= 0.0 && y[i] < box.height;
      if (!in_box) [[unlikely]]
        cross_sheared(d, i, box, tallies[b]);
      speed2 = std::max(speed2, vx[i] * vx[i] + vy[i] * vy[i]);
    }
    block_values[b] = speed2;
  });
  for (const ImpactTally& block : tallies) tally.add(block);
  double speed2 = 0.0;
  for (const double v2 : block_values) speed2 = std::max(speed2, v2);
  return speed2;
}

}  // namespace carom
