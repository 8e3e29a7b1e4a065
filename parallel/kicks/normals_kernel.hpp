// The kernel that draws normal deviates for disks, in the versions that this machine may have.
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
  bool accumulate;  // adds what is drawn to x and y, in place of setting them
};

// Draws both deviates of disks [begin, end): scale times normals(seed, stream, id, step). Returns the largest x^2 +
// y^2.
using NormalsKernel = double (*)(const NormalDraws& in, std::size_t begin, std::size_t end);

double draw_normals_baseline(const NormalDraws& in, std::size_t begin, std::size_t end);
double draw_normals_avx2(const NormalDraws& in, std::size_t begin, std::size_t end);

// The best version for the processor at hand; all give the same bits.
NormalsKernel choose_normals_kernel();

}  // namespace carom
