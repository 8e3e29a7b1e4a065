#define CAROM_MEETING_KERNELS meeting_kernels_baseline
#include "core/base/kernel_set.hpp"
#include "parallel/exact/meeting.inl"

namespace carom {

MeetingKernels choose_meeting_kernels(bool gravity, bool unequal_radii) {
  if (kernel_set() == KernelSet::avx2) return meeting_kernels_avx2(gravity, unequal_radii);
  return meeting_kernels_baseline(gravity, unequal_radii);
}

}  // namespace carom
