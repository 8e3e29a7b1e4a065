// Four doubles at a time, in vector types of the compiler, which splits them on machines without such registers.
// Included by kernels that are compiled once for every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace carom {

namespace {

constexpr std::size_t lanes = 4;

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));
using FourWords = std::int32_t __attribute__((vector_size(16)));

inline Doubles load(const double* p) {
  Doubles v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

inline void store(double* p, Doubles v) {
  __builtin_memcpy(p, &v, sizeof v);
}

inline Doubles all(double a) {
  return Doubles{a, a, a, a};
}

// A built-in cast, not std::bit_cast: without optimisation that is a function, and the linker would share it between
// versions for different instruction sets, which pass vectors in different ways.
inline Longs as_longs(Doubles v) {
  return __builtin_bit_cast(Longs, v);
}

inline bool any(Longs truth) {
#if defined(__AVX__)
  return _mm256_movemask_pd(__builtin_bit_cast(__m256d, truth)) != 0;
#else
  return (truth[0] | truth[1] | truth[2] | truth[3]) != 0;
#endif
}

}  // namespace

}  // namespace carom
