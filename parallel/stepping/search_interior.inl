// The interior search kernel, compiled once for every instruction set; CAROM_INTERIOR names the version.
// Vectors of four doubles in the compilers' own vector types: on a machine without them the compiler splits them.

#include <algorithm>
#include <cmath>

#include "parallel/stepping/search_kernel.hpp"

namespace carom {

namespace {

constexpr std::uint32_t lanes = 4;
// Disks by which the row above is asked for before it is read: it comes from memory, the own row is still in the cache.
constexpr std::size_t prefetch_ahead = 256;
using Doubles = double __attribute__((vector_size(32)));
using Longs = long long __attribute__((vector_size(32)));

inline Doubles load(const double* p) {
  Doubles v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

inline Doubles all(double a) {
  return Doubles{a, a, a, a};
}

// Bit k is set where lane k is true. The built-in cast in place of std::bit_cast: without optimisation that is a
// function of its own, which the versions for several instruction sets, with their ways to pass a vector, would share.
inline unsigned bits_of(Longs truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(__builtin_bit_cast(Doubles, truth)));
#else
  const Longs weighted = truth & Longs{1, 2, 4, 8};
  return static_cast<unsigned>(weighted[0] | weighted[1] | weighted[2] | weighted[3]);
#endif
}

// Which of the disks first .. first + 3 touch disk i; lanes at and beyond `count` are false. touches() of
// core/physics/disk_pair.hpp with the same operations. Precondition: first + 3 < n.
template <bool own_radius>
inline unsigned touching(const SearchInput& in, double x, double y, double r, std::uint32_t first,
                         std::uint32_t count) {
  const Doubles dx = load(in.x + first) - all(x);
  const Doubles dy = load(in.y + first) - all(y);
  const Doubles contact_distance = own_radius ? load(in.radius + first) + all(r) : all(r + r);
  const Longs near = dx * dx + dy * dy <= contact_distance * contact_distance;
  const auto c = static_cast<long long>(count);
  const Longs inside = Longs{0, 1, 2, 3} < Longs{c, c, c, c};
  return bits_of(near & inside);
}

inline void add_pair(std::size_t i, std::size_t j, std::vector<Pair>& pairs) {
  pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
}

inline void add_hits(std::size_t i, std::uint32_t first, unsigned hits, std::vector<Pair>& pairs) {
  for (; hits != 0; hits &= hits - 1) add_pair(i, first + static_cast<unsigned>(__builtin_ctz(hits)), pairs);
}

// A run of any length, to its end.
template <bool own_radius>
void scan_run(const SearchInput& in, std::size_t i, double r, std::uint32_t first, std::uint32_t last,
              std::vector<Pair>& pairs) {
  for (; first < last; first += lanes) {
    if (first + lanes <= in.n) {
      add_hits(i, first, touching<own_radius>(in, in.x[i], in.y[i], r, first, last - first), pairs);
      continue;
    }
    for (std::uint32_t j = first; j < last; ++j) {
      const double dx = in.x[j] - in.x[i];
      const double dy = in.y[j] - in.y[i];
      const double contact_distance = (own_radius ? in.radius[j] : r) + r;
      if (dx * dx + dy * dy <= contact_distance * contact_distance) add_pair(i, j, pairs);
    }
  }
}

template <bool own_radius>
void search_row(const SearchInput& in, const GridLevel& level, std::uint32_t row, std::size_t begin, std::size_t end,
                BlockPairs& found) {
  const std::uint32_t row_key = level.first_key + row * level.stride;
  const double middle = (row + 0.5) * level.cell_height;
  const double far_x = 0.5 * level.cell_width + level.margin;
  const double far_y = 0.5 * level.cell_height + level.margin;
  std::vector<Pair>& pairs = found.pairs;
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t key = in.key[i];
    const double x = in.x[i];
    const double y = in.y[i];
    const double r = own_radius ? in.radius[i] : in.common_radius;
    // What lies beyond the box belongs to the nearest cell however far out it is: only the way along the box counts.
    const double centre = (static_cast<int>(key - row_key) + 0.5) * level.cell_width;
    const double off_x = std::abs(std::min(std::max(x, 0.0), in.box.width) - centre);
    const double off_y = std::abs(std::min(std::max(y, 0.0), in.box.height) - middle);
    if ((off_x > far_x) | (off_y > far_y)) [[unlikely]]
      found.strays.push_back(static_cast<std::uint32_t>(i));
    const auto own = static_cast<std::uint32_t>(i + 1);
    const std::uint32_t own_end = in.start[key + 2];
    const std::uint32_t above = in.start[key + level.stride - 1];
    const std::uint32_t above_end = in.start[key + level.stride + 2];
    __builtin_prefetch(in.x + above + prefetch_ahead);
    __builtin_prefetch(in.y + above + prefetch_ahead);
    if (above + 2 * lanes <= in.n) [[likely]] {
      // The usual case without a loop: up to four disks in the own row, up to eight above.
      const unsigned hits_own = touching<own_radius>(in, x, y, r, own, own_end - own);
      const unsigned hits_above = touching<own_radius>(in, x, y, r, above, above_end - above);
      const std::uint32_t second = above + lanes;
      const unsigned hits_second =
          touching<own_radius>(in, x, y, r, second, above_end > second ? above_end - second : 0);
      if ((hits_own | hits_above | hits_second) != 0) [[unlikely]] {
        add_hits(i, own, hits_own, pairs);
        add_hits(i, above, hits_above, pairs);
        add_hits(i, second, hits_second, pairs);
      }
      if (own_end > own + lanes) [[unlikely]]
        scan_run<own_radius>(in, i, r, own + lanes, own_end, pairs);
      if (above_end > second + lanes) [[unlikely]]
        scan_run<own_radius>(in, i, r, second + lanes, above_end, pairs);
    } else {
      scan_run<own_radius>(in, i, r, own, own_end, pairs);
      scan_run<own_radius>(in, i, r, above, above_end, pairs);
    }
  }
}

}  // namespace

void CAROM_INTERIOR(const SearchInput& in, const GridLevel& level, std::uint32_t row, std::size_t begin,
                    std::size_t end, BlockPairs& found) {
  if (in.radius == nullptr) {
    search_row<false>(in, level, row, begin, end, found);
  } else {
    search_row<true>(in, level, row, begin, end, found);
  }
}

}  // namespace carom
