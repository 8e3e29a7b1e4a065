#define CAROM_MOVE_DISKS move_disks_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/stepping/move_disks.inl"

namespace carom {

MoveKernel choose_move_kernel() {
  if (kernel_set() == KernelSet::avx2) return move_disks_avx2;
  return move_disks_baseline;
}

}  // namespace carom
