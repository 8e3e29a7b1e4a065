#include "core/base/kernel_set.hpp"
#include "parallel/stepping/sweep_batches.inl"

namespace carom {

SweepKernels sweep_kernels_baseline() {
  return {relax_batches, extrapolate_batches, extrapolate_velocities};
}

SweepKernels choose_sweep_kernels() {
  return kernel_set() == KernelSet::avx2 ? sweep_kernels_avx2() : sweep_kernels_baseline();
}

}  // namespace carom
