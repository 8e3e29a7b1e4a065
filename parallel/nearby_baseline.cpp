#include "parallel/nearby_kernel.hpp"

namespace carom {

// No branch depends on a place: which neighbours are near is as good as random.
std::size_t nearby_baseline(const NearbyFrame& frame, const NearbyColumns& columns, std::uint32_t first,
                            std::uint32_t last, std::uint32_t* found) {
  std::size_t n = 0;
  for (std::uint32_t j = first; j < last; ++j) {
    const double radius = columns.radius != nullptr ? columns.radius[j] : frame.common_radius;
    const bool here = columns.next == nullptr || columns.next[j] == unchained;
    found[n] = j;
    n += static_cast<unsigned>(is_nearby(frame, columns.place[j], radius)) & static_cast<unsigned>(here) &
         static_cast<unsigned>(j != frame.self);
  }
  return n;
}

NearbyKernel choose_nearby_kernel() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return nearby_avx2;
#endif
  return nearby_baseline;
}

}  // namespace carom
