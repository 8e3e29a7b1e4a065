// Compiled with -mavx2 on x86-64 (CMakeLists.txt); elsewhere it is the baseline, which is called then.
#include "parallel/nearby_kernel.hpp"

#if defined(__AVX2__)

#include <immintrin.h>

#include <array>
#include <bit>

namespace carom {

namespace {

constexpr std::uint32_t lanes = 4;

// For each set of lanes, those in it first.
constexpr auto packing = [] {
  std::array<std::array<std::uint32_t, lanes>, 16> table{};
  for (std::uint32_t bits = 0; bits < table.size(); ++bits) {
    std::uint32_t n = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      if ((bits >> lane & 1U) != 0) table[bits][n++] = lane;
    }
  }
  return table;
}();

// |d|, at the nearest image.
inline __m256d apart(__m256d a, __m256d b, __m256d period, __m256d half) {
  const __m256d d = _mm256_andnot_pd(_mm256_set1_pd(-0.0), _mm256_sub_pd(a, b));
  return _mm256_sub_pd(d, _mm256_and_pd(_mm256_cmp_pd(d, half, _CMP_GT_OQ), period));
}

}  // namespace

std::size_t nearby_avx2(const NearbyFrame& f, const NearbyColumns& columns, std::uint32_t first, std::uint32_t last,
                        std::uint32_t* found) {
  const __m256d px = _mm256_set1_pd(f.place.x);
  const __m256d py = _mm256_set1_pd(f.place.y);
  const __m256d width = _mm256_set1_pd(f.width);
  const __m256d height = _mm256_set1_pd(f.height);
  const __m256d half_width = _mm256_set1_pd(f.half_width);
  const __m256d half_height = _mm256_set1_pd(f.half_height);
  std::size_t n = 0;
  std::uint32_t j = first;
  // The last few with some that come after them, which are masked out; where there are none, one by one.
  for (; j < last && j + lanes <= columns.count; j += lanes) {
    const double* const p = &columns.place[j].x;
    const __m256d a = _mm256_loadu_pd(p);
    const __m256d b = _mm256_loadu_pd(p + 4);
    // Lanes 0, 2, 1, 3.
    const __m256d dx = apart(_mm256_unpacklo_pd(a, b), px, width, half_width);
    const __m256d dy = apart(_mm256_unpackhi_pd(a, b), py, height, half_height);
    __m256d radius = _mm256_set1_pd(f.common_radius);
    if (columns.radius != nullptr) radius = _mm256_permute4x64_pd(_mm256_loadu_pd(columns.radius + j), 0xd8);
    const __m256d reach = _mm256_add_pd(_mm256_set1_pd(f.reach), radius);
    const __m256d distance2 = _mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy));
    const __m256d near = _mm256_cmp_pd(distance2, _mm256_mul_pd(reach, reach), _CMP_LE_OQ);
    auto bits = static_cast<unsigned>(_mm256_movemask_pd(_mm256_permute4x64_pd(near, 0xd8)));
    const __m128i at = _mm_add_epi32(_mm_set1_epi32(static_cast<int>(j)), _mm_setr_epi32(0, 1, 2, 3));
    const __m128i self = _mm_cmpeq_epi32(at, _mm_set1_epi32(static_cast<int>(f.self)));
    bits &= ~static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(self)));
    if (last - j < lanes) bits &= (1U << (last - j)) - 1U;
    if (columns.next != nullptr) {
      const __m128i next = _mm_loadu_si128(reinterpret_cast<const __m128i*>(columns.next + j));
      const __m128i here = _mm_cmpeq_epi32(next, _mm_set1_epi32(static_cast<int>(unchained)));
      bits &= static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(here)));
    }
    const __m128i pack = _mm_loadu_si128(reinterpret_cast<const __m128i*>(packing[bits].data()));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(found + n), _mm_add_epi32(pack, _mm_set1_epi32(static_cast<int>(j))));
    n += static_cast<std::size_t>(std::popcount(bits));
  }
  return j < last ? n + nearby_baseline(f, columns, j, last, found + n) : n;
}

}  // namespace carom

#else

namespace carom {

std::size_t nearby_avx2(const NearbyFrame& frame, const NearbyColumns& columns, std::uint32_t first, std::uint32_t last,
                        std::uint32_t* found) {
  return nearby_baseline(frame, columns, first, last, found);
}

}  // namespace carom

#endif
