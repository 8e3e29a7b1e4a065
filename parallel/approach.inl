// The kernel, compiled once for every instruction set; CAROM_APPROACHING and CAROM_APPROACHING_FLIGHTS name the
// versions. Four neighbours at a time, in the compilers' own vector types: on a machine without them the compiler
// splits them.

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

inline unsigned test_four(const ApproachFrame& f, const PathSegment& p0, const PathSegment& p1, const PathSegment& p2,
                          const PathSegment& p3, Doubles reach, double* least) {
  const Doubles m0 = load_motion(p0);
  const Doubles m1 = load_motion(p1);
  const Doubles m2 = load_motion(p2);
  const Doubles m3 = load_motion(p3);
  const Doubles xs01 = __builtin_shufflevector(m0, m1, 0, 4, 2, 6);  // x0 x1 vx0 vx1
  const Doubles ys01 = __builtin_shufflevector(m0, m1, 1, 5, 3, 7);
  const Doubles xs23 = __builtin_shufflevector(m2, m3, 0, 4, 2, 6);
  const Doubles ys23 = __builtin_shufflevector(m2, m3, 1, 5, 3, 7);
  const Doubles vx = __builtin_shufflevector(xs01, xs23, 2, 3, 6, 7);
  const Doubles vy = __builtin_shufflevector(ys01, ys23, 2, 3, 6, 7);
  const Doubles s = all(f.from) - Doubles{p0.start, p1.start, p2.start, p3.start};
  Doubles dx = __builtin_shufflevector(xs01, xs23, 0, 1, 4, 5) + vx * s - all(f.x);
  Doubles dy = __builtin_shufflevector(ys01, ys23, 0, 1, 4, 5) + (vy - all(0.5 * f.gravity) * s) * s - all(f.y);
  dx = dx - where(dx > all(f.half_width), all(f.width)) + where(dx < all(-f.half_width), all(f.width));
  dy = dy - where(dy > all(f.half_height), all(f.height)) + where(dy < all(-f.half_height), all(f.height));
  const Doubles dvx = vx - all(f.vx);
  const Doubles dvy = vy - all(f.gravity) * s - all(f.vy);
  const Doubles a = dvx * dvx + dvy * dvy;
  const Doubles b = dx * dvx + dy * dvy;
  const Doubles c = dx * dx + dy * dy - reach * reach;
  const Doubles b2 = b * b;
  const Doubles d = b2 * all(1.0 + cancelled) - a * c;
  const Longs overlaps = (c <= all(0.0)) | (b >= all(0.0));
  store(least, where(~overlaps, c / (root(where(d > all(0.0), d)) - b)));
  const Longs not_receding = (b <= all(0.0)) | (b2 <= all(f.blur2) * a);
  return bits_of(not_receding & (d >= all(0.0)));
}

// Neighbours near[0..3], wherever they are.
inline unsigned test_flights(const ApproachFrame& f, const Flight* flight, const std::uint32_t* near, double* least) {
  const Flight& a = flight[near[0]];
  const Flight& b = flight[near[1]];
  const Flight& c = flight[near[2]];
  const Flight& d = flight[near[3]];
  const Doubles reach = Doubles{a.radius, b.radius, c.radius, d.radius} + all(f.own_reach);
  return test_four(f, a.path, b.path, c.path, d.path, reach, least);
}

}  // namespace

std::uint32_t CAROM_APPROACHING(const ApproachFrame& frame, ApproachBatch& batch, std::uint32_t count) {
  for (std::uint32_t k = count; k % lanes != 0; ++k) {
    batch.path[k] = batch.path[0];
    batch.reach[k] = batch.reach[0];
  }
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < count; k += lanes) {
    const PathSegment* const* p = batch.path + k;
    bits |= test_four(frame, *p[0], *p[1], *p[2], *p[3], load(batch.reach + k), batch.least + k) << k;
  }
  return count == 32 ? bits : bits & ((1U << count) - 1U);
}

std::uint32_t CAROM_APPROACHING_FLIGHTS(const ApproachFrame& frame, const Flight* flight, const std::uint32_t* near,
                                        std::uint32_t count, double* least) {
  std::uint32_t bits = 0;
  std::uint32_t k = 0;
  for (; k + lanes <= count; k += lanes) bits |= test_flights(frame, flight, near + k, least + k) << k;
  if (k == count) return bits;
  std::uint32_t rest[lanes];
  for (std::uint32_t l = 0; l < lanes; ++l) rest[l] = near[k + l < count ? k + l : k];
  const unsigned some = test_flights(frame, flight, rest, least + k) & ((1U << (count - k)) - 1U);
  return bits | some << k;
}

}  // namespace carom
