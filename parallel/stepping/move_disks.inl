// The kernel that moves disks, compiled once for every instruction set; CAROM_MOVE_DISKS names the version.

#include <algorithm>
#include <array>
#include <cstring>

#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/move_kernel.hpp"
#include "parallel/stepping/vectors.inl"

namespace carom {

namespace {

constexpr std::size_t lanes = 4;
using Words = std::int32_t __attribute__((vector_size(16)));

// Added to a number and taken away again: rounds it to the nearest whole one, which meanwhile is in the lowest bits.
constexpr double rounding = 0x1.8p52;

// Four disks on their way through the kernel.
struct Four {
  Doubles x, y, vx, vy;
  Words key;
};

// What the lanes need of the step and of the level.
struct Constants {
  Doubles t, width, height;
  Doubles fall, slowing;  // by gravity, of the place and of the speed
  Doubles per_unit;       // coarse units per length
  Doubles columns_per_length, rows_per_length, columns, rows;
  Doubles far_x, far_y;  // from a cell's centre, in cells: beyond it a disk is a stray
  Doubles stride, per_stride;
  std::int32_t first_key;
};

Constants constants_for(const MoveInput& in, const GridLevel& level) {
  return {all(in.t),
          all(in.box.width),
          all(in.box.height),
          all(0.5 * in.gravity * (in.t * in.t)),
          all(in.gravity * in.t),
          all(1.0 / coarse_unit(level)),
          all(level.columns_per_length),
          all(level.rows_per_length),
          all(level.columns),
          all(level.rows),
          all(0.5 + level.margin * level.columns_per_length),
          all(0.5 + level.margin * level.rows_per_length),
          all(level.stride),
          all(1.0 / level.stride),
          static_cast<std::int32_t>(level.first_key)};
}

// wrap of core/disks/domain.hpp.
inline Doubles wrapped(Doubles c, Doubles period) {
  const Doubles above = c + period;
  const Doubles from_below = as_doubles((above < period) & as_longs(above));
  return choose(c < all(0.0), from_below, choose(c < period, c, c - period));
}

template <Motion motion, bool periodic_x, bool periodic_y>
inline void move(Four& d, const Constants& c) {
  if constexpr (motion == Motion::none) return;
  d.x += d.vx * c.t;
  if constexpr (motion == Motion::parabola) {
    d.y += d.vy * c.t - c.fall;
    d.vy -= c.slowing;
  } else {
    d.y += d.vy * c.t;
  }
  if constexpr (periodic_x) d.x = wrapped(d.x, c.width);
  if constexpr (periodic_y) d.y = wrapped(d.y, c.height);
}

// Is a coordinate, in cells, further from the centre of its cell than far? across: cells of the side.
template <bool periodic>
inline Longs is_far(Doubles coordinate, Doubles cell, Doubles far, Doubles across) {
  const Doubles off = coordinate - (cell + all(0.5));
  Doubles distance = as_doubles(as_longs(off) & Longs{~(1LL << 63), ~(1LL << 63), ~(1LL << 63), ~(1LL << 63)});
  if constexpr (periodic) {
    const Doubles round_the_corner = across - distance;
    distance = choose(round_the_corner < distance, round_the_corner, distance);
  }
  return distance > far;
}

// The quotient of a key by the stride is at least half a column away from the middle between two rows.
template <bool periodic_x, bool periodic_y>
inline Longs are_strays(const Four& d, const Constants& c) {
  const Doubles key = __builtin_convertvector(d.key - c.first_key, Doubles);
  const Doubles row = ((key + all(0.5)) * c.per_stride - all(0.5) + all(rounding)) - all(rounding);
  const Doubles column = key - row * c.stride;
  return is_far<periodic_x>(d.x * c.columns_per_length, column, c.far_x, c.columns) |
         is_far<periodic_y>(d.y * c.rows_per_length, row, c.far_y, c.rows);
}

inline Words coarse(const Four& d, const Constants& c) {
  const Longs x = as_longs(d.x * c.per_unit + all(rounding));
  const Longs y = as_longs(d.y * c.per_unit + all(rounding));
  return __builtin_convertvector((x & 0xffff) | (y << 16), Words);
}

template <Motion motion>
inline Four load_four(const MoveInput& in, std::size_t i) {
  Four d{load(in.x + i), load(in.y + i), all(0.0), all(0.0), {}};
  if constexpr (motion != Motion::none) {
    d.vx = load(in.vx + i);
    d.vy = load(in.vy + i);
  }
  __builtin_memcpy(&d.key, in.key + i, sizeof d.key);
  return d;
}

template <Motion motion>
inline void store_four(const MoveInput& in, std::size_t i, const Four& d, Words position) {
  if constexpr (motion != Motion::none) {
    store(in.x + i, d.x);
    store(in.y + i, d.y);
  }
  if constexpr (motion == Motion::parabola) store(in.vy + i, d.vy);
  __builtin_memcpy(in.position + i, &position, sizeof position);
}

template <Motion motion, bool periodic_x, bool periodic_y>
inline unsigned move_four(const MoveInput& in, const Constants& c, std::size_t i, Doubles& speed2) {
  Four d = load_four<motion>(in, i);
  move<motion, periodic_x, periodic_y>(d, c);
  const Doubles v2 = d.vx * d.vx + d.vy * d.vy;
  speed2 = choose(v2 > speed2, v2, speed2);
  store_four<motion>(in, i, d, coarse(d, c));
  return bits_of(are_strays<periodic_x, periodic_y>(d, c));
}

// The last few, [begin, end), in columns of their own that are filled up with the last disk.
template <Motion motion, bool periodic_x, bool periodic_y>
unsigned move_rest(const MoveInput& in, const Constants& c, std::size_t begin, std::size_t end, Doubles& speed2) {
  std::array<double, lanes> x{}, y{}, vx{}, vy{};
  std::array<std::uint32_t, lanes> key{}, position{};
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t i = std::min(begin + k, end - 1);
    x[k] = in.x[i];
    y[k] = in.y[i];
    vx[k] = in.vx[i];
    vy[k] = in.vy[i];
    key[k] = in.key[i];
  }
  MoveInput rest = in;
  rest.x = x.data();
  rest.y = y.data();
  rest.vx = vx.data();
  rest.vy = vy.data();
  rest.key = key.data();
  rest.position = position.data();
  const unsigned strays = move_four<motion, periodic_x, periodic_y>(rest, c, 0, speed2);
  for (std::size_t k = 0; k < end - begin; ++k) {
    in.x[begin + k] = x[k];
    in.y[begin + k] = y[k];
    in.vy[begin + k] = vy[k];
    in.position[begin + k] = position[k];
  }
  return strays & ((1U << (end - begin)) - 1U);
}

inline void add_strays(std::size_t i, unsigned bits, std::vector<std::uint32_t>& strays) {
  for (; bits != 0; bits &= bits - 1)
    strays.push_back(static_cast<std::uint32_t>(i) + static_cast<unsigned>(__builtin_ctz(bits)));
}

template <Motion motion, bool periodic_x, bool periodic_y>
double move_range(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                  std::vector<std::uint32_t>& strays) {
  const Constants c = constants_for(in, level);
  Doubles speed2 = all(0.0);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const unsigned bits = move_four<motion, periodic_x, periodic_y>(in, c, i, speed2);
    if (bits != 0) [[unlikely]]
      add_strays(i, bits, strays);
  }
  if (i < end) add_strays(i, move_rest<motion, periodic_x, periodic_y>(in, c, i, end, speed2), strays);
  double largest = 0.0;
  for (std::size_t k = 0; k < lanes; ++k) largest = std::max(largest, speed2[k]);
  return largest;
}

template <Motion motion>
double move_in_box(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                   std::vector<std::uint32_t>& strays) {
  if (in.box.periodic_x() && in.box.periodic_y()) return move_range<motion, true, true>(in, level, begin, end, strays);
  if (in.box.periodic_x()) return move_range<motion, true, false>(in, level, begin, end, strays);
  if (in.box.periodic_y()) return move_range<motion, false, true>(in, level, begin, end, strays);
  return move_range<motion, false, false>(in, level, begin, end, strays);
}

}  // namespace

double CAROM_MOVE_DISKS(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                        std::vector<std::uint32_t>& strays) {
  switch (in.motion) {
    case Motion::none:
      return move_in_box<Motion::none>(in, level, begin, end, strays);
    case Motion::straight:
      return move_in_box<Motion::straight>(in, level, begin, end, strays);
    case Motion::parabola:
      break;
  }
  return move_in_box<Motion::parabola>(in, level, begin, end, strays);
}

}  // namespace carom
