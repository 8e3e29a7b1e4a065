#define CAROM_MOVE_DISKS move_disks_baseline
#define CAROM_MOVE_SHEARED move_sheared_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/stepping/move_disks.inl"

namespace carom {

MoveKernels choose_move_kernels() {
  if (kernel_set() == KernelSet::avx2) return {move_disks_avx2, move_sheared_avx2};
  return {move_disks_baseline, move_sheared_baseline};
}

}  // namespace carom
