#define CAROM_NEAR_WALLS near_walls_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/stepping/near_walls.inl"

namespace carom {

NearWallsKernel choose_near_walls_kernel() {
  if (kernel_set() == KernelSet::avx2) return near_walls_avx2;
  return near_walls_baseline;
}

}  // namespace carom
