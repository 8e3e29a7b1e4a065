#include "parallel/exact/list_rows.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/huge_pages.hpp"

namespace carom {

namespace {

// The number of rows of new neighbours that are prefetched: always the same, which takes no branch. More are rare.
constexpr std::uint32_t prefetched_rows = 4;

// Puts the offset at place `count` and fills the rest of the kernel's batch with it. capacity: of the list.
template <std::uint32_t capacity>
void put_and_pad(std::int16_t* offsets, std::uint32_t count, std::int16_t offset) {
  // Four at once: this may write a few places too many, which does no harm, and costs no branch.
  using Four = std::int16_t __attribute__((vector_size(8)));
  const Four four = {offset, offset, offset, offset};
  static_assert(sizeof four == prediction_lanes * sizeof offset);
  if (count + prediction_lanes <= capacity) [[likely]] {
    std::memcpy(offsets + count, &four, sizeof four);
  } else {
    std::fill(offsets + count, offsets + capacity, offset);
  }
}
template <std::uint32_t capacity>
void put_and_pad(std::int32_t* offsets, std::uint32_t count, std::int32_t offset) {
  std::fill(offsets + count, offsets + std::min(count + prediction_lanes, capacity), offset);
}

// Searches a row for offsets. header: the 16 bytes before its offsets, 16-byte aligned.
class RowSearch {
 public:
#if defined(__SSE2__)
  explicit RowSearch(const void* header) {
    for (int k = 0; k < 4; ++k) part_[k] = _mm_load_si128(static_cast<const __m128i*>(header) + k);
  }
  // Bit k is set if the offset at place k is this one; the bits above those of the row may be anything.
  std::uint32_t places_of(std::int16_t offset) const {
    const __m128i sought = _mm_set1_epi16(offset);
    const auto equal = [&](int k) { return _mm_cmpeq_epi16(part_[k], sought); };
    const auto low = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(equal(0), equal(1))));
    const auto high = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(equal(2), equal(3))));
    return (high << 16 | low) >> places_before_offsets;
  }

 private:
  __m128i part_[4];
#else
  explicit RowSearch(const void* header) : offset_(static_cast<const std::int16_t*>(header) + places_before_offsets) {}
  std::uint32_t places_of(std::int16_t offset) const {
    std::uint32_t places = 0;
    for (unsigned k = 0; k < row_offsets; ++k) places |= static_cast<std::uint32_t>(offset_[k] == offset) << k;
    return places;
  }

 private:
  const std::int16_t* offset_;
#endif
};

}  // namespace

bool ListRows::surely_within(std::uint32_t i, std::uint32_t first, std::uint32_t last) const {
  const Row& row = rows_[i];
  if (row.more != none || i < first || i >= last) return false;
  const auto below = static_cast<std::int32_t>(std::min<std::uint32_t>(i - first, 32767));
  const auto above = static_cast<std::int32_t>(std::min<std::uint32_t>(last - 1 - i, 32767));
  // All places are compared, whether in use or not: what they had before is near, too.
  std::int16_t least = 0;
  std::int16_t most = 0;
  for (std::uint32_t k = 0; k < row_capacity; ++k) {
    least = std::min(least, row.offset[k]);
    most = std::max(most, row.offset[k]);
  }
  return least >= -below && most <= above;
}

void ListRows::begin(std::size_t disks, std::size_t blocks) {
  if (rows_.capacity() < disks) resize_in_huge_pages(rows_, disks, Row{}, disks + disks / 32);
  rows_.resize(disks);
  wide_.resize(blocks);
  free_wide_.assign(blocks, none);
}

void ListRows::clear_block(std::size_t block) {
  wide_[block].clear();
  free_wide_[block] = none;
}

void ListRows::enter(std::uint32_t i, std::size_t block, unsigned sides) {
  Row& row = rows_[i];
  row.more = none;
  row.count = 0;
  row.sides = static_cast<std::uint8_t>(sides);
  row.block = static_cast<std::uint16_t>(block);
}

// Precondition: no wide row is chained to the disk's row.
void ListRows::set(std::uint32_t i, std::span<const std::uint32_t> near) {
  Row& row = rows_[i];
  row.count = 0;
  if (near.size() <= row_capacity) [[likely]] {
    bool fits = true;
    for (std::size_t k = 0; k < near.size(); ++k) {
      const auto offset = static_cast<std::int32_t>(near[k] - i);
      row.offset[k] = static_cast<std::int16_t>(offset);
      fits &= offset == static_cast<std::int16_t>(offset);
    }
    if (fits) [[likely]] {
      row.count = static_cast<std::uint8_t>(near.size());
      put_and_pad<row_capacity>(row.offset, row.count, row.offset[0]);
      return;
    }
  }
  for (const std::uint32_t j : near) insert(i, j);
}

void ListRows::insert(std::uint32_t i, std::uint32_t j) {
  Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  if (row.count < row_capacity && offset == static_cast<std::int16_t>(offset)) [[likely]] {
    put_and_pad<row_capacity>(row.offset, row.count++, static_cast<std::int16_t>(offset));
  } else {
    insert_wide(row, offset);
  }
}

void ListRows::insert_wide(Row& row, std::int32_t offset) {
  std::vector<WideRow>& wide = wide_[row.block];
  if (row.more == none || wide[row.more].count == wide_row_capacity) {
    std::uint32_t fresh = free_wide_[row.block];
    if (fresh != none) {
      free_wide_[row.block] = wide[fresh].next;
    } else {
      fresh = static_cast<std::uint32_t>(wide.size());
      wide.emplace_back();
    }
    wide[fresh].count = 0;
    wide[fresh].next = row.more;
    row.more = fresh;
    row.sides |= ListRow::has_more;
  }
  WideRow& last = wide[row.more];
  put_and_pad<wide_row_capacity>(last.offset, last.count++, offset);
}

void ListRows::free_wide_rows(std::uint32_t i) {
  Row& row = rows_[i];
  while (row.more != none) {
    WideRow& wide = wide_[row.block][row.more];
    const std::uint32_t next = wide.next;
    wide.next = free_wide_[row.block];
    free_wide_[row.block] = row.more;
    row.more = next;
  }
  row.sides &= static_cast<std::uint8_t>(~ListRow::has_more);
}

// Removes disk j from the list of disk i, if it is there.
void ListRows::remove(std::uint32_t i, std::uint32_t j) {
  Row& row = rows_[i];
  const auto offset = static_cast<std::int32_t>(j - i);
  // The padding may contain the offset too, but behind it.
  const std::uint32_t places = RowSearch(&row).places_of(static_cast<std::int16_t>(offset));
  const auto place = static_cast<std::uint32_t>(std::countr_zero(places));
  if (place >= row.count || offset != static_cast<std::int16_t>(offset)) [[unlikely]] {
    remove_wide(row, offset);
    return;
  }
  --row.count;
  row.offset[place] = row.offset[row.count];
  put_and_pad<row_capacity>(row.offset, row.count, row.offset[0]);
}

void ListRows::remove_wide(Row& row, std::int32_t offset) {
  for (std::uint32_t w = row.more; w != none; w = wide_[row.block][w].next) {
    WideRow& wide = wide_[row.block][w];
    std::int32_t* const place = std::find(wide.offset, wide.offset + wide.count, offset);
    if (place == wide.offset + wide.count) continue;
    *place = wide.offset[--wide.count];
    put_and_pad<wide_row_capacity>(wide.offset, wide.count, wide.offset[0]);
    return;
  }
}

void ListRows::replace(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region) {
  const Row& row = rows_[i];
  if (row.more != none || row.count == 0) [[unlikely]] {
    exchange(i, near, region);
  } else {
    patch(i, near, region);
  }
}

// Replaces a list of any length.
void ListRows::exchange(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region) {
  for_each_neighbour(i, [&](std::uint32_t j) {
    if (region.holds(j)) remove(j, i);
  });
  free_wide_rows(i);
  for (const std::uint32_t j : near) insert(j, i);
  set(i, near);
}

// Replaces a list that is all in one row.
void ListRows::patch(std::uint32_t i, std::span<const std::uint32_t> near, const ListRegion& region) {
  Row& row = rows_[i];
  const std::uint32_t old_count = row.count;
  const Row old = row;
  std::uint32_t fresh[row_capacity + 1];
  std::fill_n(fresh, prefetched_rows, i);
  // Places beyond the new list keep their contents or become 0: surely_within reads them too.
  const ListChange change = change_kernel_(&old, old_count, i, near.data(), near.size(), {row.offset, fresh});
  if (!change.fits) [[unlikely]] {
    row = old;
    return exchange(i, near, region);
  }
  row.count = static_cast<std::uint8_t>(near.size());
  if (row.count > 0) put_and_pad<row_capacity>(row.offset, row.count, row.offset[0]);
  // Many disks' rows are not in a cache: these are fetched at the same time as those of `gone`.
  for (std::uint32_t k = 0; k < prefetched_rows; ++k) __builtin_prefetch(&rows_[fresh[k]], 1);
  std::uint32_t gone[row_capacity];
  std::uint32_t count = 0;
  for (std::uint32_t go = ~change.stay & ((1U << old_count) - 1U); go != 0; go &= go - 1U) {
    gone[count] = i + static_cast<std::uint32_t>(std::int32_t{old.offset[std::countr_zero(go)]});
    __builtin_prefetch(&rows_[gone[count]], 1);
    count += static_cast<std::uint32_t>(region.holds(gone[count]));
  }
  const std::uint32_t inserts = edit_kernels_.insert(rows_.data(), i, fresh, change.fresh_count);
  for (std::uint32_t k = 0; k < inserts; ++k) insert(fresh[k], i);
  const std::uint32_t removals = edit_kernels_.remove(rows_.data(), i, gone, count);
  for (std::uint32_t k = 0; k < removals; ++k) remove(gone[k], i);
}

}  // namespace carom
