#include "parallel/stepping/drift_blocks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/physics/advance.hpp"
#include "parallel/stepping/wall_reach.hpp"

namespace carom {

namespace {

// Disks a block: four columns of it fit the second-level cache.
constexpr std::size_t drift_block = 8192;

template <bool gravity, bool periodic_x, bool periodic_y>
double drift_range(Disks& d, const Domain& box, double g, double t, std::size_t begin, std::size_t end) {
  double* x = d.x.data();
  double* y = d.y.data();
  double* vx = d.vx.data();
  double* vy = d.vy.data();
  double speed2 = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    drift<gravity>(x[i], y[i], vx[i], vy[i], t, g);
    wrap<periodic_x, periodic_y>(x[i], y[i], box);
    const double v2 = vx[i] * vx[i] + vy[i] * vy[i];
    speed2 = v2 > speed2 ? v2 : speed2;
  }
  return speed2;
}

using DriftRange = double (*)(Disks&, const Domain&, double, double, std::size_t, std::size_t);

DriftRange choose_drift(const Domain& box, double g) {
  static constexpr std::array<DriftRange, 8> kernels{drift_range<false, false, false>, drift_range<false, false, true>,
                                                     drift_range<false, true, false>,  drift_range<false, true, true>,
                                                     drift_range<true, false, false>,  drift_range<true, false, true>,
                                                     drift_range<true, true, false>,   drift_range<true, true, true>};
  return kernels[(g > 0.0 ? 4U : 0U) + (box.periodic_x() ? 2U : 0U) + (box.periodic_y() ? 1U : 0U)];
}

}  // namespace

double drift_blocks(Disks& d, const Domain& box, double gravity, double t, const Executor& executor,
                    std::vector<double>& block_speed2) {
  const DriftRange kernel = choose_drift(box, gravity);
  block_speed2.resize(executor.blocks(d.size(), drift_block));
  executor.for_ranges(d.size(), drift_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
    block_speed2[b] = kernel(d, box, gravity, t, begin, end);
  });
  double largest = 0.0;
  for (const double v2 : block_speed2) largest = std::max(largest, v2);
  return largest;
}

void find_wall_contacts(Disks& disks, const StepRules& rules, const Executor& executor,
                        std::vector<std::vector<ContactEvent>>& buffers) {
  if (!rules.box.has(SideKind::wall)) return;
  while (buffers.size() < executor.blocks(disks.size(), drift_block)) {
    buffers.emplace_back();
    buffers.back().reserve(drift_block / 16);
  }
  buffers.resize(executor.blocks(disks.size(), drift_block));
  const WallReach walls(rules.box);
  with_view(disks, [&](const auto& d) {
    executor.for_ranges(disks.size(), drift_block, [&](std::size_t b, std::size_t begin, std::size_t end) {
      buffers[b].clear();
      for (std::size_t i = begin; i < end; ++i) {
        if (!walls.touches(d.x[i], d.y[i], d.radius(i))) continue;
        for_each_wall_contact(d, rules, static_cast<std::uint32_t>(i),
                              [&](const ContactEvent& e) { buffers[b].push_back(e); });
      }
    });
  });
}

}  // namespace carom
