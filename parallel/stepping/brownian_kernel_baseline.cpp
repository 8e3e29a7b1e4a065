#include <algorithm>

#include "core/base/kernel_set.hpp"
#include "core/base/random.hpp"
#include "parallel/stepping/brownian_kernel.hpp"

namespace carom {

double draw_brownian_baseline(const BrownianInput& in, std::size_t begin, std::size_t end) {
  double speed2 = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 r = normals(in.seed, Stream::brownian, in.id[i], in.step);
    in.vx[i] = in.accumulate ? in.vx[i] + in.speed * r.x : in.speed * r.x;
    in.vy[i] = in.accumulate ? in.vy[i] + in.speed * r.y : in.speed * r.y;
    speed2 = std::max(speed2, in.vx[i] * in.vx[i] + in.vy[i] * in.vy[i]);
  }
  return speed2;
}

BrownianKernel choose_brownian_kernel() {
  if (kernel_set() == KernelSet::avx2) return draw_brownian_avx2;
  return draw_brownian_baseline;
}

}  // namespace carom
