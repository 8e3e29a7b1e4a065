#define CAROM_INTERIOR search_interior_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/stepping/search_interior.inl"

namespace carom {

InteriorKernel choose_interior_kernel() {
  if (kernel_set() == KernelSet::avx2) return search_interior_avx2;
  return search_interior_baseline;
}

}  // namespace carom
