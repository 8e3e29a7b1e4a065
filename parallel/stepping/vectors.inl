// Vectors of four doubles in the compilers' own vector types: on a machine without them the compiler splits them.
// For kernels that are compiled once for every instruction set; all here is private to the file that includes it.
#pragma once

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

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

// Lanes that are true have all bits set. The built-in cast in place of std::bit_cast: without optimisation that is a
// function of its own, which the versions for several instruction sets, with their ways to pass a vector, would share.
inline Longs as_longs(Doubles v) {
  return __builtin_bit_cast(Longs, v);
}
inline Doubles as_doubles(Longs v) {
  return __builtin_bit_cast(Doubles, v);
}

// Lane by lane: a where true, else b.
inline Doubles choose(Longs truth, Doubles a, Doubles b) {
  return as_doubles((truth & as_longs(a)) | (~truth & as_longs(b)));
}

// Bit k is set where lane k is true.
inline unsigned bits_of(Longs truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(as_doubles(truth)));
#else
  const Longs weighted = truth & Longs{1, 2, 4, 8};
  return static_cast<unsigned>(weighted[0] | weighted[1] | weighted[2] | weighted[3]);
#endif
}

}  // namespace

}  // namespace carom
