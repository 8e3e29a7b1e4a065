#include "parallel/exact/cell_slots.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <bit>

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

// The slot of a cell that has this disk; slots_a_cell if none has. Its number is practically random, so a loop would
// have a branch that is often mispredicted.
inline std::uint32_t place_of(const std::uint32_t* slot, std::uint32_t disk) {
#if defined(__SSE2__)
  static_assert(slots_a_cell == 8);
  const __m128i sought = _mm_set1_epi32(static_cast<int>(disk));
  const auto equal = [&](int k) {
    return _mm_cmpeq_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(slot + k)), sought);
  };
  const __m128i places = _mm_packs_epi16(_mm_packs_epi32(equal(0), equal(4)), _mm_setzero_si128());
  return static_cast<std::uint32_t>(std::countr_zero(static_cast<std::uint32_t>(_mm_movemask_epi8(places)) | 1U << 8U));
#else
  std::uint32_t places = 1U << slots_a_cell;
  for (std::uint32_t k = 0; k < slots_a_cell; ++k) places |= static_cast<std::uint32_t>(slot[k] == disk) << k;
  return static_cast<std::uint32_t>(std::countr_zero(places));
#endif
}

template <class T>
void refill(std::vector<T>& column, std::size_t n, T value) {
  if (column.capacity() < n) resize_in_huge_pages(column, n);
  column.assign(n, value);
}

}  // namespace

void CellSlots::begin(std::uint32_t cells, std::uint32_t cells_a_part, bool unequal_radii) {
  SlotCell empty{};
  std::fill_n(empty.disk, slots_a_cell, none);
  refill(cells_, cells, empty);
  refill(radius_, unequal_radii ? std::size_t{cells} * slots_a_cell : 0, 0.0F);
  refill(chain_, cells, none);
  cells_a_part_ = cells_a_part;
  links_.resize(cells / cells_a_part + 1);
  for (PartLinks& part : links_) {
    part.link.clear();
    part.free = none;
  }
}

void CellSlots::insert(std::uint32_t cell, std::uint32_t disk, SlotPosition position, float radius) {
  SlotCell& slots = cells_[cell];
  const std::uint32_t place = place_of(slots.disk, none);
  if (place < slots_a_cell) [[likely]] {
    slots.disk[place] = disk;
    slots.position[place] = position;
    if (!radius_.empty()) radius_[std::size_t{cell} * slots_a_cell + place] = radius;
    return;
  }
  PartLinks& part = links_of(cell);
  std::uint32_t fresh = part.free;
  if (fresh != none) {
    part.free = part.link[fresh].next;
  } else {
    fresh = static_cast<std::uint32_t>(part.link.size());
    part.link.emplace_back();
  }
  part.link[fresh] = {disk, chain_[cell]};
  chain_[cell] = fresh;
}

void CellSlots::remove(std::uint32_t cell, std::uint32_t disk) {
  SlotCell& slots = cells_[cell];
  const std::uint32_t place = place_of(slots.disk, disk);
  if (place < slots_a_cell) [[likely]] {
    slots.disk[place] = none;
    return;
  }
  PartLinks& part = links_of(cell);
  std::uint32_t* link = &chain_[cell];
  while (part.link[*link].disk != disk) link = &part.link[*link].next;
  const std::uint32_t out = *link;
  *link = part.link[out].next;
  part.link[out].next = part.free;
  part.free = out;
}

}  // namespace carom
