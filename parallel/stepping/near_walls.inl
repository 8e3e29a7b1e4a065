// The kernel that finds the disks near walls and obstacles, compiled once for every instruction set; CAROM_NEAR_WALLS
// names the version.

#include "parallel/stepping/four_doubles.inl"
#include "parallel/stepping/near_walls.hpp"

namespace carom {

namespace {

inline Doubles least_of(Doubles a, Doubles b) {
  return a < b ? a : b;
}

// The column, or row, of Clearance::at(), as a whole number.
template <bool moving>
inline FourWords cell_of(Doubles place, double shift, double period, double cells_per_length, double cells) {
  if constexpr (moving) {
    place -= all(shift);
    place += __builtin_bit_cast(Doubles, (place < all(0.0)) & as_longs(all(period)));
  }
  // A place beyond the sides reads an arbitrary cell; its result is not used.
  const Doubles cell = place * all(cells_per_length);
  const Doubles first = all(0.0);
  return __builtin_convertvector(least_of(cell > first ? cell : first, all(cells - 1.0)), FourWords);
}

// Clearance::at(place) < r.
template <bool moving>
inline Longs may_touch(const Clearance::Cells& cells, Doubles x, Doubles y, Doubles r) {
  const Longs in_box = (x >= all(0.0)) & (y >= all(0.0)) & (x < all(cells.size.x)) & (y < all(cells.size.y));
  const FourWords column = cell_of<moving>(x, cells.shift.x, cells.period.x, cells.columns_per_length, cells.columns);
  const FourWords row = cell_of<moving>(y, cells.shift.y, cells.period.y, cells.rows_per_length, cells.rows);
  const auto columns = static_cast<std::int32_t>(cells.columns);
  const FourWords cell = row * FourWords{columns, columns, columns, columns} + column;
  const FourWords steps{cells.steps[cell[0]], cells.steps[cell[1]], cells.steps[cell[2]], cells.steps[cell[3]]};
  const Doubles clear = all(cells.step) * __builtin_convertvector(steps, Doubles);
  return ~in_box | ((moving ? clear - all(cells.blur) : clear) < r);
}

// WallReach::touches of four disks.
template <bool obstacles, bool moving>
inline Longs touches(const NearWallsInput& in, Doubles x, Doubles y, Doubles r) {
  Longs found = ((r - x) >= all(in.least[0])) | ((x + r) - all(in.width) >= all(in.least[1])) |
                ((r - y) >= all(in.least[2])) | ((y + r) - all(in.height) >= all(in.least[3]));
  if constexpr (!obstacles) return found;
  if constexpr (!moving) return found | may_touch<false>(in.obstacles[0], x, y, r);
  for (std::size_t k = 0; k < in.maps; ++k) found |= may_touch<true>(in.obstacles[k], x, y, r);
  return found;
}

template <bool obstacles, bool moving>
void near_in_range(const NearWallsInput& input, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near) {
  const NearWallsInput in = input;  // by itself, so that no store can change it
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const Doubles r = in.radius == nullptr ? all(in.common_radius) : load(in.radius + i);
    const Longs found = touches<obstacles, moving>(in, load(in.x + i), load(in.y + i), r);
    if (!any(found)) [[likely]]
      continue;
    for (std::size_t k = 0; k < lanes; ++k) {
      if (found[k] != 0) near.push_back(static_cast<std::uint32_t>(i + k));
    }
  }
  for (; i < end; ++i) {
    const double r = in.radius == nullptr ? in.common_radius : in.radius[i];
    if (touches<obstacles, moving>(in, all(in.x[i]), all(in.y[i]), all(r))[0] != 0)
      near.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace

void CAROM_NEAR_WALLS(const NearWallsInput& in, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near) {
  if (in.maps == 0) return near_in_range<false, false>(in, begin, end, near);
  if (!in.moving) return near_in_range<true, false>(in, begin, end, near);
  near_in_range<true, true>(in, begin, end, near);
}

}  // namespace carom
