// Compiled with -mavx2 on x86-64 (CMakeLists.txt); on other machines it calls the baseline.
#include "parallel/exact/path_kernels.hpp"

#if defined(__AVX2__)

#include <cstdint>

namespace carom {

namespace {

using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

constexpr std::size_t lanes = 4;

inline Doubles load(const void* from) {
  Doubles v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

inline void store(const Doubles& v, void* to) {
  __builtin_memcpy(to, &v, sizeof v);
}

inline Doubles all(double a) {
  return Doubles{a, a, a, a};
}

// Four vectors whose rows can be made columns.
struct Square {
  Doubles a, b, c, d;
};

inline Square turned(const Square& m) {
  const Doubles ab_even = __builtin_shufflevector(m.a, m.b, 0, 4, 2, 6);
  const Doubles ab_odd = __builtin_shufflevector(m.a, m.b, 1, 5, 3, 7);
  const Doubles cd_even = __builtin_shufflevector(m.c, m.d, 0, 4, 2, 6);
  const Doubles cd_odd = __builtin_shufflevector(m.c, m.d, 1, 5, 3, 7);
  return {__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5), __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
          __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7), __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)};
}

static_assert(offsetof(PathSegment, vy) == offsetof(PathSegment, x) + 3 * sizeof(double));

inline void begin_path(const BegunPaths& in, std::size_t i, const Doubles& motion) {
  constexpr auto relist = __builtin_bit_cast(std::uint32_t, Partner::relist());
  constexpr auto none = __builtin_bit_cast(std::uint32_t, Partner::none());
  DiskRecord& record = in.record[i];
  record.path.start = 0.0;
  store(motion, &record.path.x);
  record.radius = in.radius;
  record.id = in.id[i];
  std::uint32_t partner = 0;
  __builtin_memcpy(&partner, &record.partner, sizeof partner);
  partner = partner == relist && in.relists_stay ? relist : none;
  __builtin_memcpy(static_cast<void*>(&record.partner), &partner, sizeof partner);
  record.version = record.partner_version = 0;
}

// Shifts the times of four entries; their other members stay.
inline void shift_times(const BegunPaths& in, std::size_t i) {
  const Doubles first = load(in.entry + i);
  const Doubles second = load(in.entry + i + 2);
  const Doubles times = (__builtin_shufflevector(first, second, 0, 4, 2, 6) - all(in.length)) - all(in.early);
  store(__builtin_shufflevector(times, first, 0, 5, 2, 7), in.entry + i);
  store(__builtin_shufflevector(times, second, 1, 5, 3, 7), in.entry + i + 2);
}
static_assert(sizeof(CalendarEntry) == 2 * sizeof(double) && offsetof(CalendarEntry, time) == 0);

void begin_paths(const BegunPaths& job, std::size_t begin, std::size_t end) {
  const BegunPaths in = job;  // a copy in registers, since stores might change the original
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const Square motion = turned({load(in.x + i), load(in.y + i), load(in.vx + i), load(in.vy + i)});
    begin_path(in, i, motion.a);
    begin_path(in, i + 1, motion.b);
    begin_path(in, i + 2, motion.c);
    begin_path(in, i + 3, motion.d);
    shift_times(in, i);
  }
  path_kernels_baseline().begin(job, i, end);
}

void end_paths(const EndedPaths& job, std::size_t begin, std::size_t end) {
  const EndedPaths in = job;
  const Doubles length = all(in.length);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const DiskRecord* const r = in.record + i;
    const Square m = turned({load(&r[0].path.x), load(&r[1].path.x), load(&r[2].path.x), load(&r[3].path.x)});
    const Doubles start{r[0].path.start, r[1].path.start, r[2].path.start, r[3].path.start};
    const Doubles s = length - start;
    const Longs moves = start != length;
    const Doubles x = moves ? m.a + m.c * s : m.a;
    const Doubles y = moves ? m.b + m.d * s : m.b;
    const Longs out = (x < all(in.left)) | (x >= all(in.right)) | (y < all(in.bottom)) | (y >= all(in.top));
    if (__builtin_ia32_movmskpd256(__builtin_bit_cast(Doubles, out)) != 0) [[unlikely]] {
      path_kernels_baseline().end(job, i, i + lanes);
      continue;
    }
    store(x, in.x + i);
    store(y, in.y + i);
    store(m.c, in.vx + i);
    store(m.d, in.vy + i);
  }
  path_kernels_baseline().end(job, i, end);
}

}  // namespace

PathKernels path_kernels_avx2() {
  return {begin_paths, end_paths};
}

}  // namespace carom

#else

namespace carom {

PathKernels path_kernels_avx2() {
  return path_kernels_baseline();
}

}  // namespace carom

#endif
