// Compiled with -mavx2 on x86-64 (CMakeLists.txt); on other machines it calls the baseline.
#include "parallel/exact/list_kernel.hpp"

#if defined(__AVX2__)

#include <immintrin.h>

#include <array>

namespace carom {

namespace {

constexpr std::uint32_t lanes = 8;

// For each set of lanes the permutation that puts these lanes first.
constexpr auto packing = [] {
  std::array<std::array<std::uint8_t, lanes>, 256> table{};
  for (std::uint32_t bits = 0; bits < table.size(); ++bits) {
    std::uint32_t n = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      if ((bits >> lane & 1U) != 0) table[bits][n++] = static_cast<std::uint8_t>(lane);
    }
  }
  return table;
}();

// The query, in every lane.
struct Lanes {
  __m256i position, unit, self;
  __m256 cutoff, radius, cutoff2;
};

static_assert(slots_a_cell == lanes);

// Appends the near disks of a cell, packed, to `found`. radius: of the cell's slots.
template <bool unequal_radii>
inline std::size_t take(const Lanes& l, const SlotCell& cell, const float* radius, std::uint32_t* found) {
  const auto load = [](const auto* column) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(column)); };
  const __m256i disk = load(cell.disk);
  const __m256i position = load(cell.position);
  // In each lane, x is in the lower half and y in the upper one.
  const __m256i apart = _mm256_abs_epi16(_mm256_sub_epi16(l.position, position));
  const __m256i distances = _mm256_mulhrs_epi16(apart, l.unit);
  const __m256 distance2 = _mm256_cvtepi32_ps(_mm256_madd_epi16(distances, distances));
  __m256 cutoff2 = l.cutoff2;
  if constexpr (unequal_radii) {
    const __m256 cutoff = _mm256_add_ps(l.cutoff, _mm256_add_ps(l.radius, _mm256_loadu_ps(radius)));
    cutoff2 = _mm256_mul_ps(cutoff, cutoff);
  }
  // Empty slots are excluded by the sign bit, which is set in their number.
  static_assert((empty_slot >> 31U) != 0);
  const __m256i excluded = _mm256_or_si256(_mm256_cmpeq_epi32(disk, l.self), disk);
  const __m256i near = _mm256_castps_si256(_mm256_cmp_ps(distance2, cutoff2, _CMP_LE_OQ));
  const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_andnot_si256(excluded, near))));
  const __m128i order = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(packing[bits].data()));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(found),
                      _mm256_permutevar8x32_epi32(disk, _mm256_cvtepu8_epi32(order)));
  return static_cast<std::size_t>(__builtin_popcount(bits));
}

template <bool unequal_radii>
std::size_t find(const ListQuery& q, const SlotColumns& columns, const CellBlock& block, std::uint32_t* found) {
  const float cutoff = q.cutoff + (q.radius + q.radius);
  const Lanes l{_mm256_set1_epi32(static_cast<int>(std::uint32_t{q.position.y} << 16U | q.position.x)),
                _mm256_set1_epi32(static_cast<int>(static_cast<std::uint32_t>(q.unit_y) << 16U |
                                                   static_cast<std::uint32_t>(q.unit_x))),
                _mm256_set1_epi32(static_cast<int>(q.self)),
                _mm256_set1_ps(q.cutoff),
                _mm256_set1_ps(q.radius),
                _mm256_set1_ps(cutoff * cutoff)};
  const SlotCell* first = columns.cell + block.first;
  const float* radius = unequal_radii ? columns.radius + std::size_t{block.first} * lanes : nullptr;
  const std::size_t radii_a_row = unequal_radii ? std::size_t{block.stride} * lanes : 0;
  std::size_t n = 0;
  for (std::uint32_t left = block.rows; left > 0; --left, first += block.stride, radius += radii_a_row) {
    const SlotCell* cell = first;
    const SlotCell* const end = first + block.width;
    const float* of_cell = radius;
    do {
      n += take<unequal_radii>(l, *cell, of_cell, found + n);
      if constexpr (unequal_radii) of_cell += lanes;
    } while (++cell < end);
  }
  return n;
}

// Writes the offsets from disk i, eight at a time, and 0 at places beyond the last one. Returns false if they do not
// fit in 16 bits.
inline bool put_offsets(std::uint32_t i, const std::uint32_t* near, std::size_t count, std::int16_t* offset) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i own = _mm256_set1_epi32(static_cast<int>(i));
  __m256i beyond = _mm256_setzero_si256();
  for (std::size_t k = 0; k < count; k += lanes) {
    const __m256i is_one = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count - k)), lane);
    const __m256i disk = _mm256_maskload_epi32(reinterpret_cast<const int*>(near + k), is_one);
    const __m256i far = _mm256_and_si256(_mm256_sub_epi32(disk, own), is_one);
    const __m128i packed = _mm_packs_epi32(_mm256_castsi256_si128(far), _mm256_extracti128_si256(far, 1));
    beyond = _mm256_or_si256(beyond, _mm256_xor_si256(_mm256_cvtepi16_epi32(packed), far));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(offset + k), packed);
  }
  return _mm256_testz_si256(beyond, beyond) != 0;
}

// Puts the offset at place `count` and at the places of the padding behind it.
inline void put_and_pad(ListRow& row, std::uint32_t count, std::int16_t offset) {
  static_assert(row_padding * sizeof offset == 8);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(row.offset + count), _mm_set1_epi16(offset));
}

// Rows that are nearly full are left to the caller: they have no room for the padding.
[[gnu::hot]] std::uint32_t insert_into_rows(ListRow* rows, std::uint32_t i, std::uint32_t* disks, std::uint32_t count) {
  std::uint32_t left = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t j = disks[k];
    ListRow& row = rows[j];
    const auto far = static_cast<std::int32_t>(i - j);
    const auto offset = static_cast<std::int16_t>(far);
    if (row.count + row_padding <= row_offsets && far == offset) [[likely]] {
      put_and_pad(row, row.count, offset);
      ++row.count;
    } else {
      disks[left++] = j;
    }
  }
  return left;
}

[[gnu::hot]] std::uint32_t remove_from_rows(ListRow* rows, std::uint32_t i, std::uint32_t* disks, std::uint32_t count) {
  std::uint32_t left = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t j = disks[k];
    ListRow& row = rows[j];
    const auto far = static_cast<std::int32_t>(i - j);
    const auto* const half = reinterpret_cast<const __m256i*>(&row);
    const __m256i sought = _mm256_set1_epi16(static_cast<short>(far));
    const __m256i packed = _mm256_packs_epi16(_mm256_cmpeq_epi16(_mm256_load_si256(half), sought),
                                              _mm256_cmpeq_epi16(_mm256_load_si256(half + 1), sought));
    const auto places = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(packed, 0xd8)));
    // The padding may contain the offset too, but behind it.
    const auto place =
        static_cast<std::uint32_t>(__builtin_ctzll(std::uint64_t{places} >> places_before_offsets | 1ULL << 32U));
    const std::uint32_t last = row.count - 1U;
    // The row may be empty while neighbours that did not fit in it remain in wide rows.
    if (place < row.count && last + row_padding <= row_offsets && far == static_cast<std::int16_t>(far)) [[likely]] {
      row.offset[place] = row.offset[last];
      put_and_pad(row, last, row.offset[0]);
      row.count = static_cast<std::uint8_t>(last);
    } else {
      disks[left++] = j;
    }
  }
  return left;
}

}  // namespace

EditKernels edit_kernels_avx2() {
  return {insert_into_rows, remove_from_rows};
}

std::size_t list_kernel_avx2(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                             std::uint32_t* found) {
  return columns.radius == nullptr ? find<false>(query, columns, block, found)
                                   : find<true>(query, columns, block, found);
}

// Compares sixteen places at a time; unused places become 0, which is no neighbour's offset.
ListChange change_kernel_avx2(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                              std::size_t new_count, const NewList& to) {
  ListChange change;
  constexpr short before = places_before_offsets;
  change.fits = new_count <= row_offsets;
  if (!change.fits) return change;
  const auto* const half = static_cast<const __m256i*>(row);
  const __m256i place = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m256i end = _mm256_set1_epi16(static_cast<short>(count + before));
  const __m256i is_offset = _mm256_cmpgt_epi16(place, _mm256_set1_epi16(before - 1));
  const __m256i later = _mm256_add_epi16(place, _mm256_set1_epi16(16));
  const __m256i low =
      _mm256_and_si256(_mm256_load_si256(half), _mm256_and_si256(is_offset, _mm256_cmpgt_epi16(end, place)));
  const __m256i high = _mm256_and_si256(_mm256_load_si256(half + 1), _mm256_cmpgt_epi16(end, later));
  change.fits = put_offsets(i, near, new_count, to.offset);
  __m256i low_stays = _mm256_setzero_si256();
  __m256i high_stays = _mm256_setzero_si256();
  std::size_t fresh = 0;
  for (std::size_t k = 0; k < new_count; ++k) {
    const __m256i sought = _mm256_set1_epi16(to.offset[k]);
    const __m256i in_low = _mm256_cmpeq_epi16(low, sought);
    const __m256i in_high = _mm256_cmpeq_epi16(high, sought);
    const __m256i any = _mm256_or_si256(in_low, in_high);
    low_stays = _mm256_or_si256(low_stays, in_low);
    high_stays = _mm256_or_si256(high_stays, in_high);
    to.fresh[fresh] = near[k];
    fresh += static_cast<std::size_t>(_mm256_testz_si256(any, any));
  }
  change.fresh_count = static_cast<std::uint32_t>(fresh);
  const __m256i bytes = _mm256_permute4x64_epi64(_mm256_packs_epi16(low_stays, high_stays), 0xd8);
  change.stay = static_cast<std::uint32_t>(_mm256_movemask_epi8(bytes)) >> before;
  return change;
}

}  // namespace carom

#else

namespace carom {

std::size_t list_kernel_avx2(const ListQuery& query, const SlotColumns& columns, const CellBlock& block,
                             std::uint32_t* found) {
  return list_kernel_baseline(query, columns, block, found);
}

ListChange change_kernel_avx2(const void* row, std::uint32_t count, std::uint32_t i, const std::uint32_t* near,
                              std::size_t new_count, const NewList& to) {
  return change_kernel_baseline(row, count, i, near, new_count, to);
}

EditKernels edit_kernels_avx2() {
  return edit_kernels_baseline();
}

}  // namespace carom

#endif
