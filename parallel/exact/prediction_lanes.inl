// Four doubles at a time, for the prediction kernel: in the compilers' own vector types, which the compiler splits on a
// machine without vectors of four. Included only by prediction_kernel.inl, once for every instruction set.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/physics/exact_path.hpp"
#include "parallel/exact/prediction_kernel.hpp"

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

constexpr std::uint32_t lanes = prediction_lanes;

static_assert(offsetof(PathSegment, vy) == offsetof(PathSegment, x) + 3 * sizeof(double));
static_assert(sizeof(LaneConstant) == sizeof(Doubles));

// x, y, vx, vy of a segment.
inline Doubles load_motion(const PathSegment& p) {
  Doubles v;
  __builtin_memcpy(&v, &p.x, sizeof v);
  return v;
}

inline Doubles load(const LaneConstant& c) {
  Doubles v;
  __builtin_memcpy(&v, c.lane, sizeof v);
  return v;
}

inline Doubles all(double a) {
  return Doubles{a, a, a, a};
}

inline Longs bits(Doubles a) {
  return __builtin_bit_cast(Longs, a);
}

inline Doubles number(Longs a) {
  return __builtin_bit_cast(Doubles, a);
}

inline Doubles choose(Longs truth, Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_ia32_blendvpd256(b, a, number(truth));
#else
  return number((truth & bits(a)) | (~truth & bits(b)));
#endif
}

// a if the sign bit of `sign` is set, otherwise b.
inline Doubles choose_by_sign(Doubles sign, Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_ia32_blendvpd256(b, a, sign);
#else
  return choose(bits(sign) >> 63, a, b);
#endif
}

inline Doubles root(Doubles v) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_sqrtpd256(v));
#else
  return Doubles{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

// The next two functions give b if a or b is not a number.
inline Doubles larger(Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_maxpd256(a, b));
#else
  return choose(a > b, a, b);
#endif
}

inline Doubles smaller(Doubles a, Doubles b) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, __builtin_ia32_minpd256(a, b));
#else
  return choose(a < b, a, b);
#endif
}

// Bit k is set if lane k is true.
inline unsigned bits_of(Longs truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(number(truth)));
#else
  const Longs weighted = truth & Longs{1, 2, 4, 8};
  return static_cast<unsigned>(weighted[0] | weighted[1] | weighted[2] | weighted[3]);
#endif
}

inline bool any_true(Longs truth) {
#if defined(__AVX__)
  return __builtin_ia32_vtestzpd256(number(truth), number(truth)) == 0;
#else
  return bits_of(truth) != 0;
#endif
}

// The least of the four, in all lanes.
inline Doubles least_of_all(Doubles v) {
  const Doubles pairs = smaller(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
  return smaller(pairs, __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2));
}

// The element of v, whole numbers below 2^31, in the first lane whose bit is set.
inline std::uint32_t lane_of(Longs v, unsigned set) {
#if defined(__AVX2__)
  using Ints = int __attribute__((vector_size(32)));
  const Ints halves = __builtin_bit_cast(Ints, v);
  const int lower = 2 * __builtin_ctz(set);
  return static_cast<std::uint32_t>(__builtin_ia32_permvarsi256(halves, Ints{lower})[0]);
#else
  return static_cast<std::uint32_t>(v[__builtin_ctz(set)]);
#endif
}

// Rounds to the nearest whole number, |v| < 2^51.
inline Doubles rounded(Doubles v) {
#if defined(__AVX__)
  return __builtin_ia32_roundpd256(v, 8);
#else
  constexpr double shift = 0x1.8p52;
  return (v + all(shift)) - all(shift);
#endif
}

// Further than 0.01 periods from half a period this takes the same image as core's nearest_image, by the same single
// subtraction: d - 0 is d, and d - (-period) is d + period.
inline Doubles nearest(Doubles d, const LaneConstant& period, const LaneConstant& periods_per_length) {
  return d - load(period) * rounded(d * load(periods_per_length));
}

}  // namespace

}  // namespace carom
