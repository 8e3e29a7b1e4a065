// The kernel, compiled once for every instruction set; CAROM_SKETCH_MEETINGS names the version. Eight neighbours at a
// time, in the compilers' own vector types: on a machine without them the compiler splits them.

#include <bit>
#include <cmath>
#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "parallel/sketch_kernel.hpp"

namespace carom {

namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = int __attribute__((vector_size(32)));
using Quad = float __attribute__((vector_size(16)));

constexpr std::uint32_t lanes = 8;
// Of squares of distances and what is derived from them: many times what single precision loses.
constexpr float rounding = 1e-5F;
// Of times, where nearly all of b has cancelled.
constexpr float early = 0.999F;
// Keeps slow disks' squares from vanishing.
constexpr float least_square = 1e-30F;

inline Quad load(const PathSketch& s) {
  Quad v;
  __builtin_memcpy(&v, &s, sizeof v);
  return v;
}

inline Floats all(float a) {
  return Floats{a, a, a, a, a, a, a, a};
}

inline Floats pair_of(Quad a, Quad b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

// a where truth, else 0.
inline Floats where(Ints truth, Floats a) {
  return std::bit_cast<Floats>(truth & std::bit_cast<Ints>(a));
}

inline Floats root_of(Floats a) {
#if defined(__AVX__)
  return std::bit_cast<Floats>(_mm256_sqrt_ps(std::bit_cast<__m256>(a)));
#else
  Floats r = a;
  for (std::uint32_t k = 0; k < lanes; ++k) r[k] = std::sqrt(a[k]);
  return r;
#endif
}

// Bit k is set where lane k is true.
inline unsigned bits_of(Ints truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(truth)));
#else
  unsigned bits = 0;
  for (std::uint32_t k = 0; k < lanes; ++k) bits |= truth[k] != 0 ? 1U << k : 0U;
  return bits;
#endif
}

inline Floats reach_of(const SketchFrame& f, const std::uint32_t* disk) {
  if (f.radius == nullptr) return all(f.reach);
  Floats r;
  for (std::uint32_t k = 0; k < lanes; ++k) r[k] = static_cast<float>(f.radius[disk[k]]);
  return r * all(f.per_length) + all(f.reach);
}

inline unsigned test_eight(const SketchFrame& f, const PathSketch* s, const std::uint32_t* disk, float* soonest) {
  const Floats s04 = pair_of(load(s[disk[0]]), load(s[disk[4]]));
  const Floats s15 = pair_of(load(s[disk[1]]), load(s[disk[5]]));
  const Floats s26 = pair_of(load(s[disk[2]]), load(s[disk[6]]));
  const Floats s37 = pair_of(load(s[disk[3]]), load(s[disk[7]]));
  const Floats place01 = __builtin_shufflevector(s04, s15, 0, 8, 1, 9, 4, 12, 5, 13);  // x0 x1 y0 y1, x4 x5 y4 y5
  const Floats place23 = __builtin_shufflevector(s26, s37, 0, 8, 1, 9, 4, 12, 5, 13);
  const Floats speed01 = __builtin_shufflevector(s04, s15, 2, 10, 3, 11, 6, 14, 7, 15);
  const Floats speed23 = __builtin_shufflevector(s26, s37, 2, 10, 3, 11, 6, 14, 7, 15);
  const Floats vx = __builtin_shufflevector(speed01, speed23, 0, 1, 8, 9, 4, 5, 12, 13);
  const Floats vy = __builtin_shufflevector(speed01, speed23, 2, 3, 10, 11, 6, 7, 14, 15);
  const Floats from = all(f.from);
  Floats dx = __builtin_shufflevector(place01, place23, 0, 1, 8, 9, 4, 5, 12, 13) + vx * from - all(f.x);
  Floats dy = __builtin_shufflevector(place01, place23, 2, 3, 10, 11, 6, 7, 14, 15) + vy * from - all(f.y);
  dx = dx - where(dx > all(f.half_width), all(f.width)) + where(dx < all(-f.half_width), all(f.width));
  dy = dy - where(dy > all(f.half_height), all(f.height)) + where(dy < all(-f.half_height), all(f.height));
  const Floats dvx = vx - all(f.vx);
  const Floats dvy = vy - all(f.vy);
  const Floats reach = reach_of(f, disk);
  const Floats a = dvx * dvx + dvy * dvy + all(least_square);
  const Floats b = dx * dvx + dy * dvy;
  const Floats d2 = dx * dx + dy * dy;
  const Floats lost = d2 * all(rounding);
  const Floats c = d2 - reach * reach - lost;
  const Floats b2 = b * b;
  const Floats discriminant = b2 - a * c;
  const Floats blur2 = all(4.0F * f.slack * f.slack) + lost * all(rounding);
  // Ruled out only where a comparison that is true says so.
  const Ints recedes = (b > all(0.0F)) & (b2 > blur2 * a);
  const Ints ruled_out = recedes | (discriminant < all(0.0F));
  const Floats root = root_of(where(~ruled_out, discriminant));
  const Floats time = all(early) * c / (root - b);
  // Now, where they touch, may have passed the nearest point, or the numbers are out of range.
  const Floats later = where((b < all(0.0F)) & (c > all(0.0F)) & (time > all(0.0F)), time);
  __builtin_memcpy(soonest, &later, sizeof later);
  return bits_of(~ruled_out);
}

}  // namespace

std::uint32_t CAROM_SKETCH_MEETINGS(const SketchFrame& frame, const PathSketch* sketches, std::uint32_t* disk,
                                    std::uint32_t count, float* soonest) {
  for (std::uint32_t k = count; k % lanes != 0; ++k) disk[k] = disk[0];
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < count; k += lanes) bits |= test_eight(frame, sketches, disk + k, soonest + k) << k;
  return count == 32 ? bits : bits & ((1U << count) - 1U);
}

}  // namespace carom
