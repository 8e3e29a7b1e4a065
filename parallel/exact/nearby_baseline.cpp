#include "core/base/kernel_set.hpp"
#include "parallel/exact/nearby_kernel.hpp"

namespace carom {

// No branch depends on a place: which neighbours are near is as good as random.
std::size_t nearby_baseline(const NearbyFrame& frame, const NearbyColumns& columns, const DiskRun* runs,
                            std::size_t count, std::uint32_t* found) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t j = runs[k].first; j < runs[k].last; ++j) {
      const bool here = columns.next == nullptr || columns.next[j] == unchained;
      found[n] = j;
      n += static_cast<unsigned>(is_nearby(frame, columns.spot[j], radius_in(frame, columns, j))) &
           static_cast<unsigned>(here) & static_cast<unsigned>(j != frame.self);
    }
  }
  return n;
}

NearbyKernel choose_nearby_kernel() {
  if (kernel_set() == KernelSet::avx2) return nearby_avx2;
  return nearby_baseline;
}

}  // namespace carom
