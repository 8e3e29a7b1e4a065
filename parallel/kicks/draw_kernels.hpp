// The kernels that draw random numbers for disks, in versions for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/random.hpp"
#include "core/base/types.hpp"

namespace carom {

struct NormalDraws {
  double* x;  // one entry a disk, as y and id
  double* y;
  const DiskId* id;
  std::uint64_t seed;
  Stream stream;
  std::uint64_t step;
  double scale;     // of the deviates
  bool accumulate;  // adds the deviates to x and y instead of setting them
};

// Draws both deviates for disks [begin, end): scale times normals(seed, stream, id, step). Returns the largest x^2 +
// y^2.
using NormalsKernel = double (*)(const NormalDraws& in, std::size_t begin, std::size_t end);

struct UniformDraws {
  double* u;  // one entry a disk, as id
  const DiskId* id;
  std::uint64_t seed;
  Stream stream;
  std::uint64_t step;
};

// Draws for disks [0, count): uniforms(seed, stream, id, step).a.
using UniformsKernel = void (*)(const UniformDraws& in, std::size_t count);

double draw_normals_baseline(const NormalDraws& in, std::size_t begin, std::size_t end);
double draw_normals_avx2(const NormalDraws& in, std::size_t begin, std::size_t end);
void draw_uniforms_baseline(const UniformDraws& in, std::size_t count);
void draw_uniforms_avx2(const UniformDraws& in, std::size_t count);

struct DrawKernels {
  NormalsKernel normals;
  UniformsKernel uniforms;
};

// The best versions for this processor; all give the same bits.
DrawKernels choose_draw_kernels();

}  // namespace carom
