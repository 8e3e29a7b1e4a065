#include "core/measure/motion_profile.hpp"

#include <algorithm>
#include <limits>

#include "core/disks/cell_index.hpp"

namespace carom {

MotionProfile empty_profile(std::size_t slabs) {
  const std::vector<double> zeros(slabs, 0.0);
  return {std::vector<Count>(slabs, 0), zeros, zeros, zeros, zeros, 0};
}

namespace {

// Sums over a slab in one sample. Velocities are relative to that of the first disk, u, so that a slow motion within a
// fast flow is not lost in the rounding of the flow's energy.
struct SlabSample {
  double mass = 0.0;
  Vec2 u, momentum;      // momentum: m (v - u)
  double twice_k = 0.0;  // m (v - u)^2

  void add(double m, double vx, double vy) {
    if (mass == 0.0) u = {vx, vy};
    const double dx = vx - u.x, dy = vy - u.y;
    mass += m;
    momentum.x += m * dx;
    momentum.y += m * dy;
    twice_k += m * (dx * dx + dy * dy);
  }
};

// Adds a sample of slab k to the sums, as Chan, Golub and LeVeque (1983) combine variances.
void add_sample(MotionProfile& profile, std::size_t k, const SlabSample& s) {
  if (s.mass == 0.0) return;
  const Vec2 mean{s.momentum.x / s.mass, s.momentum.y / s.mass};  // relative to u
  const double within = s.twice_k - (s.momentum.x * mean.x + s.momentum.y * mean.y);
  double between = 0.0;
  if (profile.mass[k] > 0.0) {
    const double dx = (s.u.x - profile.px[k] / profile.mass[k]) + mean.x;
    const double dy = (s.u.y - profile.py[k] / profile.mass[k]) + mean.y;
    between = profile.mass[k] * (s.mass / (profile.mass[k] + s.mass)) * (dx * dx + dy * dy);
  }
  profile.twice_thermal[k] += std::max(0.0, within) + between;
  profile.mass[k] += s.mass;
  profile.px[k] += s.mass * s.u.x + s.momentum.x;
  profile.py[k] += s.mass * s.u.y + s.momentum.y;
}

}  // namespace

void add_motion(MotionProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x) {
  const double slabs_per_length = static_cast<double>(profile.disks.size()) / (along_x ? box.width : box.height);
  std::vector<SlabSample> sample(profile.disks.size());
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const std::size_t k = cell_index((along_x ? d.x[i] : d.y[i]) * slabs_per_length, profile.disks.size());
      ++profile.disks[k];
      sample[k].add(d.mass_of(i), d.vx[i], d.vy[i]);
    }
  });
  for (std::size_t k = 0; k < sample.size(); ++k) add_sample(profile, k, sample[k]);
  ++profile.samples;
}

void join(MotionProfile& profile, const MotionProfile& other) {
  for (std::size_t k = 0; k < profile.disks.size(); ++k) {
    const double mass = profile.mass[k], more = other.mass[k];
    if (mass > 0.0 && more > 0.0) {
      const double dx = other.px[k] / more - profile.px[k] / mass;
      const double dy = other.py[k] / more - profile.py[k] / mass;
      profile.twice_thermal[k] += mass * (more / (mass + more)) * (dx * dx + dy * dy);
    }
    profile.twice_thermal[k] += other.twice_thermal[k];
    profile.disks[k] += other.disks[k];
    profile.mass[k] += more;
    profile.px[k] += other.px[k];
    profile.py[k] += other.py[k];
  }
  profile.samples += other.samples;
}

SlabMotion motion_of_slab(const MotionProfile& p, std::size_t k) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (p.disks[k] == 0) return {{nothing, nothing}, nothing};
  const Vec2 v{p.px[k] / p.mass[k], p.py[k] / p.mass[k]};
  return {v, 0.5 * p.twice_thermal[k] / static_cast<double>(p.disks[k])};
}

}  // namespace carom
