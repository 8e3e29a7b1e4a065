#include "core/measure/motion_profile.hpp"

#include <limits>

#include "core/disks/cell_index.hpp"

namespace carom {

MotionProfile empty_profile(std::size_t slabs) {
  const std::vector<double> zeros(slabs, 0.0);
  return {std::vector<Count>(slabs, 0), zeros, zeros, zeros, zeros, 0};
}

void add_motion(MotionProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x) {
  const double slabs_per_length = static_cast<double>(profile.disks.size()) / (along_x ? box.width : box.height);
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const std::size_t k = cell_index((along_x ? d.x[i] : d.y[i]) * slabs_per_length, profile.disks.size());
      const double m = d.mass_of(i);
      ++profile.disks[k];
      profile.mass[k] += m;
      profile.px[k] += m * d.vx[i];
      profile.py[k] += m * d.vy[i];
      profile.twice_k[k] += m * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
    }
  });
  ++profile.samples;
}

SlabMotion motion_of_slab(const MotionProfile& p, std::size_t k) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (p.disks[k] == 0) return {{nothing, nothing}, nothing};
  const Vec2 v{p.px[k] / p.mass[k], p.py[k] / p.mass[k]};
  const double flow = p.px[k] * v.x + p.py[k] * v.y;  // M V^2
  return {v, 0.5 * (p.twice_k[k] - flow) / static_cast<double>(p.disks[k])};
}

}  // namespace carom
