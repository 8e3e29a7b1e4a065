#define CAROM_SKETCH_MEETINGS sketch_meetings_baseline
#include "parallel/sketch.inl"

namespace carom {

SketchKernel choose_sketch_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return sketch_meetings_avx2;
#endif
  return sketch_meetings_baseline;
}

}  // namespace carom
