#include <algorithm>

#include "core/base/kernel_set.hpp"
#include "parallel/kicks/draw_kernels.hpp"

namespace carom {

double draw_normals_baseline(const NormalDraws& in, std::size_t begin, std::size_t end) {
  double largest2 = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 r = normals(in.seed, in.stream, in.id[i], in.step);
    in.x[i] = in.accumulate ? in.x[i] + in.scale * r.x : in.scale * r.x;
    in.y[i] = in.accumulate ? in.y[i] + in.scale * r.y : in.scale * r.y;
    largest2 = std::max(largest2, in.x[i] * in.x[i] + in.y[i] * in.y[i]);
  }
  return largest2;
}

void draw_uniforms_baseline(const UniformDraws& in, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) in.u[i] = uniforms(in.seed, in.stream, in.id[i], in.step).a;
}

DrawKernels choose_draw_kernels() {
  if (kernel_set() == KernelSet::avx2) return {draw_normals_avx2, draw_uniforms_avx2};
  return {draw_normals_baseline, draw_uniforms_baseline};
}

}  // namespace carom
