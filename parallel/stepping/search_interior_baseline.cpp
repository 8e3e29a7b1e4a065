#define CAROM_INTERIOR search_interior_baseline
#include "parallel/stepping/search_interior.inl"

namespace carom {

InteriorKernel choose_interior_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return search_interior_avx2;
#endif
  return search_interior_baseline;
}

}  // namespace carom
