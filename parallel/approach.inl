// The kernel, compiled once for every instruction set; CAROM_APPROACHING names the version. Four neighbours at a time,
// in the compilers' own vector types: on a machine without them the compiler splits them.

#include <bit>
#include <cmath>
#include <cstddef>

#include "parallel/approach_kernel.hpp"

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

constexpr std::uint32_t lanes = 4;
// Share of b^2: many times what rounding takes from the discriminant, of which little is left where disks come from far
// away.
constexpr double cancelled = 1e-14;

static_assert(offsetof(PathSegment, vy) == offsetof(PathSegment, x) + 3 * sizeof(double));

// x, y, vx, vy of a segment.
inline Doubles load_motion(const PathSegment& p) {
  Doubles v;
  __builtin_memcpy(&v, &p.x, sizeof v);
  return v;
}

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

// a where truth, else 0.
inline Doubles where(Longs truth, Doubles a) {
  return std::bit_cast<Doubles>(truth & std::bit_cast<Longs>(a));
}

inline Doubles root(Doubles v) {
#if defined(__AVX__)
  return std::bit_cast<Doubles>(__builtin_ia32_sqrtpd256(v));
#else
  return Doubles{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

// Bit k is set where lane k is true.
inline unsigned bits_of(Longs truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(std::bit_cast<Doubles>(truth)));
#else
  const Longs weighted = truth & Longs{1, 2, 4, 8};
  return static_cast<unsigned>(weighted[0] | weighted[1] | weighted[2] | weighted[3]);
#endif
}

inline unsigned test_four(const ApproachFrame& f, ApproachBatch& batch, std::uint32_t k) {
  const PathSegment* const* p = batch.path + k;
  const Doubles m0 = load_motion(*p[0]);
  const Doubles m1 = load_motion(*p[1]);
  const Doubles m2 = load_motion(*p[2]);
  const Doubles m3 = load_motion(*p[3]);
  const Doubles xs01 = __builtin_shufflevector(m0, m1, 0, 4, 2, 6);  // x0 x1 vx0 vx1
  const Doubles ys01 = __builtin_shufflevector(m0, m1, 1, 5, 3, 7);
  const Doubles xs23 = __builtin_shufflevector(m2, m3, 0, 4, 2, 6);
  const Doubles ys23 = __builtin_shufflevector(m2, m3, 1, 5, 3, 7);
  const Doubles vx = __builtin_shufflevector(xs01, xs23, 2, 3, 6, 7);
  const Doubles vy = __builtin_shufflevector(ys01, ys23, 2, 3, 6, 7);
  const Doubles s = all(f.from) - Doubles{p[0]->start, p[1]->start, p[2]->start, p[3]->start};
  Doubles dx = __builtin_shufflevector(xs01, xs23, 0, 1, 4, 5) + vx * s - all(f.x);
  Doubles dy = __builtin_shufflevector(ys01, ys23, 0, 1, 4, 5) + (vy - all(0.5 * f.gravity) * s) * s - all(f.y);
  dx = dx - where(dx > all(f.half_width), all(f.width)) + where(dx < all(-f.half_width), all(f.width));
  dy = dy - where(dy > all(f.half_height), all(f.height)) + where(dy < all(-f.half_height), all(f.height));
  const Doubles dvx = vx - all(f.vx);
  const Doubles dvy = vy - all(f.gravity) * s - all(f.vy);
  const Doubles reach = load(batch.reach + k);
  const Doubles a = dvx * dvx + dvy * dvy;
  const Doubles b = dx * dvx + dy * dvy;
  const Doubles c = dx * dx + dy * dy - reach * reach;
  const Doubles b2 = b * b;
  const Doubles d = b2 * all(1.0 + cancelled) - a * c;
  const Longs overlaps = (c <= all(0.0)) | (b >= all(0.0));
  store(batch.least + k, where(~overlaps, c / (root(where(d > all(0.0), d)) - b)));
  const Longs not_receding = (b <= all(0.0)) | (b2 <= all(f.blur2) * a);
  return bits_of(not_receding & (d >= all(0.0)));
}

}  // namespace

std::uint32_t CAROM_APPROACHING(const ApproachFrame& frame, ApproachBatch& batch, std::uint32_t count) {
  for (std::uint32_t k = count; k % lanes != 0; ++k) {
    batch.path[k] = batch.path[0];
    batch.reach[k] = batch.reach[0];
  }
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < count; k += lanes) bits |= test_four(frame, batch, k) << k;
  return count == 32 ? bits : bits & ((1U << count) - 1U);
}

}  // namespace carom
