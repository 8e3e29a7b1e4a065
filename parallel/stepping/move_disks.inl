// The kernels that move disks, compiled once for every instruction set; CAROM_MOVE_DISKS and CAROM_MOVE_SHEARED name
// the version.

#include <algorithm>
#include <cmath>

#include "core/physics/advance.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/four_doubles.inl"
#include "parallel/stepping/move_kernel.hpp"

namespace carom {

namespace {

using Words = std::int32_t __attribute__((vector_size(32)));

// Adding this to a number rounds it to the nearest whole number, which is then in the lowest bits.
constexpr double rounding = 0x1.8p52;

inline Doubles magnitude(Doubles v) {
  constexpr long long all_but_sign = ~(1LL << 63);
  return __builtin_bit_cast(Doubles, as_longs(v) & Longs{all_but_sign, all_but_sign, all_but_sign, all_but_sign});
}

inline Doubles load_keys(const std::uint32_t* p) {
#if defined(__AVX__)
  return __builtin_bit_cast(Doubles, _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))));
#else
  FourWords v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, Doubles);
#endif
}

// The geometry of a level's cells and coarse positions, for the kernels.
struct LevelView {
  double per_unit;  // coarse units per length
  double columns_per_length, rows_per_length;
  double far_x, far_y;  // a disk further than this from its cell's centre, in cells, is a stray
  double columns, rows;
  double first_key, stride, per_stride;
  bool corner_x, corner_y;  // may a disk be at the opposite end of the box from its cell?
};

// In a sheared box a disk that has crossed the bottom or the top is displaced along x as well, and so is a stray.
LevelView view_of(const GridLevel& level, const Domain& box) {
  return {1.0 / coarse_unit(level),
          level.columns_per_length,
          level.rows_per_length,
          0.5 + level.margin * level.columns_per_length,
          0.5 + level.margin * level.rows_per_length,
          static_cast<double>(level.columns),
          static_cast<double>(level.rows),
          static_cast<double>(level.start_key()) - static_cast<double>(level.first_row) * level.stride,
          static_cast<double>(level.stride),
          1.0 / level.stride,
          box.periodic_x(),
          box.periodic_y() && !box.shear.acts()};
}

// The row of a key, counted from the level's first key. The quotient by the stride is at least half a column away from
// the middle between two whole numbers, so that rounding gives the right one.
template <class Number>
inline Number row_of(Number key, Number per_stride, Number half, Number rounder) {
  return ((key + half) * per_stride - half + rounder) - rounder;
}

// Along a period the cell may be at the opposite end of the box.
inline bool is_far(double off, double far, double across, bool periodic) {
  const double distance = std::abs(off);
  return (periodic ? std::min(distance, across - distance) : distance) > far;
}

bool is_stray(const MoveInput& in, const LevelView& v, std::size_t i) {
  const double key = in.key[i] - v.first_key;
  const double row = row_of(key, v.per_stride, 0.5, rounding);
  const double column = key - row * v.stride;
  return is_far(in.x[i] * v.columns_per_length - (column + 0.5), v.far_x, v.columns, v.corner_x) ||
         is_far(in.y[i] * v.rows_per_length - (row + 0.5), v.far_y, v.rows, v.corner_y);
}

inline std::uint32_t coarse(double x, double y, double per_unit) {
  const auto bits = [&](double c) { return __builtin_bit_cast(unsigned long long, c* per_unit + rounding); };
  return static_cast<std::uint32_t>((bits(x) & 0xffffU) | (bits(y) << 16U));
}

// Wraps disk i, which has been moved, and writes its coarse position.
template <bool periodic_x, bool periodic_y>
void finish_one(const MoveInput& in, const LevelView& v, std::size_t i, std::vector<std::uint32_t>& strays) {
  if (in.motion != Motion::none) wrap<periodic_x, periodic_y>(in.x[i], in.y[i], in.box);
  in.position[i] = coarse(in.x[i], in.y[i], v.per_unit);
  if (is_stray(in, v, i)) strays.push_back(static_cast<std::uint32_t>(i));
}

// Few disks cross a periodic side or stray. Not inlined, so that the loop over all keeps its registers.
template <bool periodic_x, bool periodic_y>
[[gnu::noinline]] void finish_four(const MoveInput& in, const GridLevel& level, std::size_t i,
                                   std::vector<std::uint32_t>& strays) {
  const LevelView v = view_of(level, in.box);
  for (std::size_t k = i; k < i + lanes; ++k) finish_one<periodic_x, periodic_y>(in, v, k, strays);
}

// The remaining disks, one by one. Returns their largest squared speed.
template <Motion motion, bool periodic_x, bool periodic_y>
double move_rest(MoveInput in, const GridLevel& level, std::size_t begin, std::size_t end,
                 std::vector<std::uint32_t>& strays) {
  const LevelView v = view_of(level, in.box);
  double speed2 = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if constexpr (motion != Motion::none)
      drift<motion != Motion::straight>(in.x[i], in.y[i], in.vx[i], in.vy[i], in.t, in.gravity);
    finish_one<periodic_x, periodic_y>(in, v, i, strays);
    speed2 = std::max(speed2, in.vx[i] * in.vx[i] + in.vy[i] * in.vy[i]);
  }
  return speed2;
}

inline double largest_of(Doubles v) {
  return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
}

template <Motion motion, bool periodic_x, bool periodic_y>
double move_range(const MoveInput& input, const GridLevel& level, std::size_t begin, std::size_t end,
                  std::vector<std::uint32_t>& strays) {
  const MoveInput in = input;  // by itself, so that no store can change it
  const LevelView v = view_of(level, in.box);
  const double fall = 0.5 * in.gravity.down * (in.t * in.t);
  const double slowing = in.gravity.down * in.t + 0.0;  // as drift does, for the sign of a zero
  const double fall_x = 0.5 * in.gravity.left * (in.t * in.t);
  const double slowing_x = in.gravity.left * in.t + 0.0;
  Doubles speed2 = all(0.0);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    Doubles x = load(in.x + i);
    Doubles y = load(in.y + i);
    // drift of core/physics/advance.hpp.
    if constexpr (motion != Motion::none) {
      Doubles vx = load(in.vx + i);
      Doubles vy = load(in.vy + i);
      if constexpr (motion == Motion::tilted_parabola) {
        x += vx * all(in.t) - all(fall_x);
        vx -= all(slowing_x);
        store(in.vx + i, vx);
      } else {
        x += vx * all(in.t);
      }
      if constexpr (motion == Motion::parabola || motion == Motion::tilted_parabola) {
        y += vy * all(in.t) - all(fall);
        vy -= all(slowing);
        store(in.vy + i, vy);
      } else {
        y += vy * all(in.t);
      }
      store(in.x + i, x);
      store(in.y + i, y);
      const Doubles v2 = vx * vx + vy * vy;
      speed2 = v2 > speed2 ? v2 : speed2;
    }
    const Doubles key = load_keys(in.key + i) - all(v.first_key);
    const Doubles row = row_of(key, all(v.per_stride), all(0.5), all(rounding));
    const Doubles column = key - row * all(v.stride);
    const Doubles off_x = x * all(v.columns_per_length) - (column + all(0.5));
    const Doubles off_y = y * all(v.rows_per_length) - (row + all(0.5));
    Longs special = (magnitude(off_x) > all(v.far_x)) | (magnitude(off_y) > all(v.far_y));
    if constexpr (periodic_x) special |= (x < all(0.0)) | (x >= all(in.box.width));
    if constexpr (periodic_y) special |= (y < all(0.0)) | (y >= all(in.box.height));
    const Longs coarse_x = as_longs(x * all(v.per_unit) + all(rounding));
    const Longs coarse_y = as_longs(y * all(v.per_unit) + all(rounding));
    const auto words = __builtin_bit_cast(Words, (coarse_x & 0xffff) | (coarse_y << 16));
    const FourWords position = __builtin_shufflevector(words, words, 0, 2, 4, 6);
    __builtin_memcpy(in.position + i, &position, sizeof position);
    if (any(special)) [[unlikely]]
      finish_four<periodic_x, periodic_y>(input, level, i, strays);
  }
  return std::max(largest_of(speed2), move_rest<motion, periodic_x, periodic_y>(in, level, i, end, strays));
}

template <Motion motion>
double move_in_box(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                   std::vector<std::uint32_t>& strays) {
  if (in.box.periodic_x() && in.box.periodic_y()) return move_range<motion, true, true>(in, level, begin, end, strays);
  if (in.box.periodic_x()) return move_range<motion, true, false>(in, level, begin, end, strays);
  if (in.box.periodic_y()) return move_range<motion, false, true>(in, level, begin, end, strays);
  return move_range<motion, false, false>(in, level, begin, end, strays);
}

template <Motion motion>
double move_sheared_range(const MoveInput& input, std::size_t begin, std::size_t end,
                          std::vector<std::uint32_t>& crossed) {
  const MoveInput in = input;  // by itself, so that no store can change it
  const Doubles width = all(in.box.width), height = all(in.box.height);
  const auto see = [&](std::size_t i, bool in_box) {
    if (!in_box) crossed.push_back(static_cast<std::uint32_t>(i));
  };
  Doubles speed2 = all(0.0);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    Doubles x = load(in.x + i);
    Doubles y = load(in.y + i);
    const Doubles vx = load(in.vx + i);
    const Doubles vy = load(in.vy + i);
    if constexpr (motion != Motion::none) {
      x += vx * all(in.t);
      y += vy * all(in.t);
      store(in.x + i, x);
      store(in.y + i, y);
    }
    Doubles v2 = vx * vx + vy * vy;
    const Longs in_box = (x >= all(0.0)) & (x < width) & (y >= all(0.0)) & (y < height);
    if (any(~in_box)) [[unlikely]] {
      for (std::size_t k = 0; k < lanes; ++k) see(i + k, in_box[k] != 0);
      v2 = __builtin_bit_cast(Doubles, as_longs(v2) & in_box);
    }
    speed2 = v2 > speed2 ? v2 : speed2;
  }
  double largest2 = largest_of(speed2);
  for (; i < end; ++i) {
    double& x = in.x[i];
    double& y = in.y[i];
    if constexpr (motion != Motion::none) drift<false>(x, y, in.vx[i], in.vy[i], in.t, 0.0);
    const bool in_box = x >= 0.0 && x < in.box.width && y >= 0.0 && y < in.box.height;
    see(i, in_box);
    if (in_box) largest2 = std::max(largest2, in.vx[i] * in.vx[i] + in.vy[i] * in.vy[i]);
  }
  return largest2;
}

}  // namespace

double CAROM_MOVE_SHEARED(const MoveInput& in, std::size_t begin, std::size_t end,
                          std::vector<std::uint32_t>& crossed) {
  return in.motion == Motion::none ? move_sheared_range<Motion::none>(in, begin, end, crossed)
                                   : move_sheared_range<Motion::straight>(in, begin, end, crossed);
}

double CAROM_MOVE_DISKS(const MoveInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                        std::vector<std::uint32_t>& strays) {
  switch (in.motion) {
    case Motion::none:
      return move_in_box<Motion::none>(in, level, begin, end, strays);
    case Motion::straight:
      return move_in_box<Motion::straight>(in, level, begin, end, strays);
    case Motion::parabola:
      return move_in_box<Motion::parabola>(in, level, begin, end, strays);
    case Motion::tilted_parabola:
      break;
  }
  return move_in_box<Motion::tilted_parabola>(in, level, begin, end, strays);
}

}  // namespace carom
