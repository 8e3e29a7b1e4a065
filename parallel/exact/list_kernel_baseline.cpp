#include <cstring>

#include "core/base/kernel_set.hpp"
#include "parallel/exact/list_kernel.hpp"

namespace carom {

std::size_t list_kernel_baseline(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                                 std::uint32_t* found) {
  std::size_t n = 0;
  // No branch depends on a position, since which disks are near is practically random.
  const auto take = [&](std::uint32_t c, std::uint32_t slot) {
    const std::uint32_t disk = columns.cell[c].disk[slot];
    const float radius =
        columns.radius != nullptr ? columns.radius[std::size_t{c} * slots_a_cell + slot] : query.radius;
    found[n] = disk;
    n += static_cast<unsigned>(is_neighbour(query, columns.cell[c].position[slot], radius)) &
         static_cast<unsigned>(disk != empty_slot) & static_cast<unsigned>(disk != query.self);
  };
  for (std::uint32_t row = 0; row < block.rows; ++row) {
    const std::uint32_t first = block.first + row * block.stride;
    for (std::uint32_t c = first; c < first + block.width; ++c) {
      for (std::uint32_t slot = 0; slot < slots_a_cell; ++slot) take(c, slot);
    }
  }
  return n;
}

ListChange change_kernel_baseline(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                                  std::size_t new_count, const NewList& to) {
  ListChange change;
  constexpr std::size_t before_offsets = places_before_offsets * sizeof(std::int16_t);
  std::int16_t old[row_offsets];
  std::memcpy(old, static_cast<const char*>(row) + before_offsets, sizeof old);
  change.fits = new_count <= row_offsets;
  for (std::size_t k = 0; change.fits && k < new_count; ++k) {
    const auto far = static_cast<std::int32_t>(near[k] - i);
    const auto offset = static_cast<std::int16_t>(far);
    change.fits = far == offset;
    to.offset[k] = offset;
    std::uint32_t places = 0;
    for (std::uint32_t place = 0; place < count; ++place) {
      places |= static_cast<std::uint32_t>(old[place] == offset) << place;
    }
    change.stay |= places;
    to.fresh[change.fresh_count] = near[k];
    change.fresh_count += static_cast<std::uint32_t>(places == 0);
  }
  return change;
}

EditKernels edit_kernels_baseline() {
  const auto leave = [](ListRow*, std::uint32_t, std::uint32_t*, std::uint32_t count) { return count; };
  return {leave, leave};
}

EditKernels choose_edit_kernels() {
  if (kernel_set() == KernelSet::avx2) return edit_kernels_avx2();
  return edit_kernels_baseline();
}

ChangeKernel choose_change_kernel() {
  if (kernel_set() == KernelSet::avx2) return change_kernel_avx2;
  return change_kernel_baseline;
}

ListKernel choose_list_kernel() {
  if (kernel_set() == KernelSet::avx2) return list_kernel_avx2;
  return list_kernel_baseline;
}

}  // namespace carom
