#define CAROM_PREDICTION_KERNELS prediction_kernels_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/exact/prediction_kernel.inl"

namespace carom {

PredictionKernels choose_prediction_kernels(Bend bend, bool unequal_radii) {
  if (kernel_set() == KernelSet::avx2) return prediction_kernels_avx2(bend, unequal_radii);
  return prediction_kernels_baseline(bend, unequal_radii);
}

}  // namespace carom
