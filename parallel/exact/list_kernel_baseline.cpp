#include "core/base/kernel_set.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

// No branch depends on a position: which disks are near is as good as random.
std::size_t list_kernel_baseline(const ListQuery& query, const SlotColumns& columns, const SlotRun* runs,
                                 std::size_t count, std::uint32_t* found) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t s = runs[k].first; s < runs[k].last; ++s) {
      const std::uint32_t disk = columns.disk[s];
      const float radius = columns.radius != nullptr ? columns.radius[s] : query.common_radius;
      found[n] = disk;
      n += static_cast<unsigned>(is_neighbour(query, columns.position[s], radius)) &
           static_cast<unsigned>(disk != empty_slot) & static_cast<unsigned>(disk != query.self);
    }
  }
  return n;
}

ListKernel choose_list_kernel() {
  if (kernel_set() == KernelSet::avx2) return list_kernel_avx2;
  return list_kernel_baseline;
}

}  // namespace carom
