// Eight coarse positions at once, in the instruction set of the file that includes this one.

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "parallel/stepping/coarse_positions.hpp"

namespace carom {

namespace {

constexpr std::uint32_t lanes = coarse_lanes;

// Eight coarse positions or radii, or eight squared distances: x and y of 16 bits side by side, or one number of 32.
#if defined(__AVX2__)

struct Eight {
  __m256i v;
};
inline Eight load(const std::uint32_t* p) {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline Eight all(std::uint32_t a) {
  return {_mm256_set1_epi32(static_cast<int>(a))};
}
inline Eight difference(Eight a, Eight b) {
  return {_mm256_sub_epi16(a.v, b.v)};
}
inline Eight sum(Eight a, Eight b) {
  return {_mm256_add_epi16(a.v, b.v)};
}
// x x + y y.
inline Eight squared(Eight a) {
  return {_mm256_madd_epi16(a.v, a.v)};
}
// All bits of the lanes in which a > b.
inline Eight exceeds(Eight a, Eight b) {
  return {_mm256_cmpgt_epi32(a.v, b.v)};
}
inline Eight either(Eight a, Eight b) {
  return {_mm256_or_si256(a.v, b.v)};
}
inline unsigned bits_of(Eight truth) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(truth.v)));
}

#elif defined(__SSE2__)

struct Eight {
  __m128i low, high;
};
inline Eight load(const std::uint32_t* p) {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)),
          _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + 4))};
}
inline Eight all(std::uint32_t a) {
  const __m128i v = _mm_set1_epi32(static_cast<int>(a));
  return {v, v};
}
inline Eight difference(Eight a, Eight b) {
  return {_mm_sub_epi16(a.low, b.low), _mm_sub_epi16(a.high, b.high)};
}
inline Eight sum(Eight a, Eight b) {
  return {_mm_add_epi16(a.low, b.low), _mm_add_epi16(a.high, b.high)};
}
inline Eight squared(Eight a) {
  return {_mm_madd_epi16(a.low, a.low), _mm_madd_epi16(a.high, a.high)};
}
inline Eight exceeds(Eight a, Eight b) {
  return {_mm_cmpgt_epi32(a.low, b.low), _mm_cmpgt_epi32(a.high, b.high)};
}
inline Eight either(Eight a, Eight b) {
  return {_mm_or_si128(a.low, b.low), _mm_or_si128(a.high, b.high)};
}
inline unsigned bits_of(Eight truth) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(truth.low))) |
         static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(truth.high))) << 4U;
}

#else

// Sums of two squares of 16 bits fit into 32 without sign.
struct Eight {
  std::uint32_t v[lanes];
};
template <class Operation>
inline Eight lane_by_lane(Operation&& operation) {
  Eight result;
  for (std::uint32_t k = 0; k < lanes; ++k) result.v[k] = operation(k);
  return result;
}
inline Eight load(const std::uint32_t* p) {
  return lane_by_lane([&](std::uint32_t k) { return p[k]; });
}
inline Eight all(std::uint32_t a) {
  return lane_by_lane([&](std::uint32_t) { return a; });
}
inline Eight difference(Eight a, Eight b) {
  return lane_by_lane(
      [&](std::uint32_t k) { return ((a.v[k] - b.v[k]) & 0xffffU) | (((a.v[k] >> 16) - (b.v[k] >> 16)) << 16); });
}
inline Eight sum(Eight a, Eight b) {
  return lane_by_lane(
      [&](std::uint32_t k) { return ((a.v[k] + b.v[k]) & 0xffffU) | (((a.v[k] >> 16) + (b.v[k] >> 16)) << 16); });
}
inline Eight squared(Eight a) {
  return lane_by_lane([&](std::uint32_t k) {
    const std::int32_t x = static_cast<std::int16_t>(a.v[k]);
    const std::int32_t y = static_cast<std::int16_t>(a.v[k] >> 16);
    return static_cast<std::uint32_t>(x * x) + static_cast<std::uint32_t>(y * y);
  });
}
inline Eight exceeds(Eight a, Eight b) {
  return lane_by_lane([&](std::uint32_t k) { return a.v[k] > b.v[k] ? ~0U : 0U; });
}
inline Eight either(Eight a, Eight b) {
  return lane_by_lane([&](std::uint32_t k) { return a.v[k] | b.v[k]; });
}
inline unsigned bits_of(Eight truth) {
  unsigned bits = 0;
  for (std::uint32_t k = 0; k < lanes; ++k) bits |= (truth.v[k] & 1U) << k;
  return bits;
}

#endif

}  // namespace

}  // namespace carom
