#include "core/base/kernel_set.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

// No branch depends on a position: which disks are near is as good as random.
std::size_t list_kernel_baseline(const ListQuery& query, const ListColumns& columns, const DiskRun* runs,
                                 std::size_t count, std::uint32_t* found) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t j = runs[k].first; j < runs[k].last; ++j) {
      const bool here = columns.next == nullptr || columns.next[j] == unchained;
      found[n] = j;
      n += static_cast<unsigned>(is_neighbour(query, columns.position[j], radius_in(query, columns, j))) &
           static_cast<unsigned>(here) & static_cast<unsigned>(j != query.self);
    }
  }
  return n;
}

ListKernel choose_list_kernel() {
  if (kernel_set() == KernelSet::avx2) return list_kernel_avx2;
  return list_kernel_baseline;
}

}  // namespace carom
