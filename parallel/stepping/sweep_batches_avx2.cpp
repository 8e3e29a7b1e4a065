// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is a second copy of the baseline that nothing calls.
#include "parallel/stepping/sweep_batches.inl"

namespace carom {

SweepKernels sweep_kernels_avx2() {
  return {relax_batches, extrapolate_batches, extrapolate_velocities};
}

}  // namespace carom
