#define CAROM_MEETING_KERNELS meeting_kernels_baseline
#include "parallel/exact/meeting.inl"

namespace carom {

MeetingKernels choose_meeting_kernels(bool gravity, bool unequal_radii) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return meeting_kernels_avx2(gravity, unequal_radii);
#endif
  return meeting_kernels_baseline(gravity, unequal_radii);
}

}  // namespace carom
