#include "parallel/kicks/draw_velocities.hpp"

#include <algorithm>

#include "core/physics/advance.hpp"
#include "parallel/kicks/draw_kernels.hpp"

namespace carom {

namespace {

// Disks in a block.
constexpr std::size_t draw_block = 8192;

}  // namespace

double draw_velocities(Disks& d, const Scene& scene, double dt, Count step, const Executor& executor,
                       std::vector<double>& scratch) {
  const NormalsKernel kernel = choose_draw_kernels().normals;
  const NormalDraws in{d.vx.data(),
                       d.vy.data(),
                       d.id.data(),
                       scene.seed,
                       Stream::brownian,
                       step,
                       brownian_speed(scene.physics.diffusion, dt),
                       scene.physics.accumulate};
  scratch.assign(executor.blocks(d.size(), draw_block), 0.0);
  executor.for_ranges(d.size(), draw_block,
                      [&](std::size_t b, std::size_t begin, std::size_t end) { scratch[b] = kernel(in, begin, end); });
  double speed2 = 0.0;
  for (const double v2 : scratch) speed2 = std::max(speed2, v2);
  return speed2;
}

}  // namespace carom
