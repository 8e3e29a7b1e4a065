// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it calls the baseline.
#include "parallel/exact/list_kernel.hpp"

#if defined(__AVX2__)

#include <immintrin.h>

#include <array>
#include <bit>

namespace carom {

namespace {

constexpr std::uint32_t lanes = 8;

// For each set of lanes, those in it first.
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

// The query in every lane.
struct Lanes {
  __m256i x, y, self;
  __m256 unit_x, unit_y, cutoff, cutoff2;
};

// Lanes that are near.
template <bool unequal_radii>
inline __m256 near_lanes(const Lanes& l, const ListQuery& q, const ListColumns& columns, std::uint32_t j) {
  const auto* const p = reinterpret_cast<const float*>(columns.position + j);
  const __m256 a = _mm256_loadu_ps(p);
  const __m256 b = _mm256_loadu_ps(p + lanes);
  // Lanes 0, 1, 4, 5, 2, 3, 6, 7, put in order at the end.
  const __m256i x = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
  const __m256i y = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xdd));
  const __m256 dx = _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(x, l.x)), l.unit_x);
  const __m256 dy = _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(y, l.y)), l.unit_y);
  const __m256 unordered = _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy));
  const __m256 distance2 = _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(unordered), 0xd8));
  if constexpr (!unequal_radii) return _mm256_cmp_ps(distance2, l.cutoff2, _CMP_LE_OQ);
  const __m256d per_length = _mm256_set1_pd(q.per_length);
  const __m128 low = _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_loadu_pd(columns.radius + j), per_length));
  const __m128 high = _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_loadu_pd(columns.radius + j + 4), per_length));
  const __m256 cutoff = _mm256_add_ps(l.cutoff, _mm256_set_m128(high, low));
  return _mm256_cmp_ps(distance2, _mm256_mul_ps(cutoff, cutoff), _CMP_LE_OQ);
}

// Packs the lanes of a run of up to `left` disks from j on.
inline std::size_t take(const Lanes& l, const ListColumns& columns, std::uint32_t j, std::uint32_t left, __m256 near,
                        std::uint32_t* found) {
  const __m256i number = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i at = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(j)), number);
  __m256i taken = _mm256_andnot_si256(_mm256_cmpeq_epi32(at, l.self), _mm256_castps_si256(near));
  taken = _mm256_and_si256(taken, _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(left)), number));
  if (columns.next != nullptr) {
    const __m256i next = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(columns.next + j));
    taken = _mm256_and_si256(taken, _mm256_cmpeq_epi32(next, _mm256_set1_epi32(static_cast<int>(unchained))));
  }
  const auto bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(taken)));
  const __m128i order = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(packing[bits].data()));
  const __m256i packed = _mm256_add_epi32(_mm256_cvtepu8_epi32(order), _mm256_set1_epi32(static_cast<int>(j)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(found), packed);
  return static_cast<std::size_t>(std::popcount(bits));
}

template <bool unequal_radii>
std::size_t find(const ListQuery& q, const ListColumns& columns, const DiskRun* runs, std::size_t count,
                 std::uint32_t* found) {
  const float cutoff = q.cutoff + q.common_radius;
  const Lanes l{_mm256_set1_epi32(static_cast<int>(q.position.x)),
                _mm256_set1_epi32(static_cast<int>(q.position.y)),
                _mm256_set1_epi32(static_cast<int>(q.self)),
                _mm256_set1_ps(q.unit_x),
                _mm256_set1_ps(q.unit_y),
                _mm256_set1_ps(q.cutoff),
                _mm256_set1_ps(cutoff * cutoff)};
  std::size_t n = 0;
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t j = runs[k].first;
    const std::uint32_t last = runs[k].last;
    // The last few together with disks that follow them, which are masked out; where none follow, one by one.
    for (; j < last && j + lanes <= columns.count; j += lanes) {
      n += take(l, columns, j, last - j, near_lanes<unequal_radii>(l, q, columns, j), found + n);
    }
    if (j < last) {
      const DiskRun rest{j, last};
      n += list_kernel_baseline(q, columns, &rest, 1, found + n);
    }
  }
  return n;
}

}  // namespace

std::size_t list_kernel_avx2(const ListQuery& query, const ListColumns& columns, const DiskRun* runs, std::size_t count,
                             std::uint32_t* found) {
  return columns.radius == nullptr ? find<false>(query, columns, runs, count, found)
                                   : find<true>(query, columns, runs, count, found);
}

}  // namespace carom

#else

namespace carom {

std::size_t list_kernel_avx2(const ListQuery& query, const ListColumns& columns, const DiskRun* runs, std::size_t count,
                             std::uint32_t* found) {
  return list_kernel_baseline(query, columns, runs, count, found);
}

}  // namespace carom

#endif
