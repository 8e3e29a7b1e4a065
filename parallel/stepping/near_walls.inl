// The kernel that finds the disks at walls and obstacles, compiled once for every instruction set; CAROM_NEAR_WALLS
// names the version.

#include "parallel/stepping/four_doubles.inl"
#include "parallel/stepping/near_walls.hpp"

namespace carom {

namespace {

// Clearance::at(place) < r.
inline Longs may_touch(const Clearance::Cells& cells, Doubles x, Doubles y, Doubles r) {
  const Doubles column = x * all(cells.columns_per_length);
  const Doubles row = y * all(cells.rows_per_length);
  const Longs in_box =
      (column >= all(0.0)) & (row >= all(0.0)) & (column < all(cells.columns)) & (row < all(cells.rows));
  // Others look at cell 0, for nothing.
  const auto whole = [&](Doubles v) {
    return __builtin_convertvector(__builtin_bit_cast(Doubles, as_longs(v) & in_box), FourWords);
  };
  const auto columns = static_cast<std::int32_t>(cells.columns);
  const FourWords cell = whole(row) * FourWords{columns, columns, columns, columns} + whole(column);
  const FourWords away{cells.away[cell[0]], cells.away[cell[1]], cells.away[cell[2]], cells.away[cell[3]]};
  const Doubles around = all(cells.share) * (__builtin_convertvector(away, Doubles) - all(1.0));
  return ~in_box | (around * all(cells.cell) < r);
}

// WallReach::touches of four disks.
template <bool obstacles, bool moving>
inline Longs touches(const NearWallsInput& in, Doubles x, Doubles y, Doubles r) {
  const Longs wall = ((r - x) >= all(in.least[0])) | ((x + r) - all(in.width) >= all(in.least[1])) |
                     ((r - y) >= all(in.least[2])) | ((y + r) - all(in.height) >= all(in.least[3]));
  if constexpr (!obstacles) return wall;
  const Longs at_rest = wall | may_touch(in.obstacles[0], x, y, r);
  if constexpr (!moving) return at_rest;
  return at_rest | may_touch(in.obstacles[1], x, y, r);
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
  if (in.obstacles[0].away == nullptr) return near_in_range<false, false>(in, begin, end, near);
  if (in.obstacles[1].away == nullptr) return near_in_range<true, false>(in, begin, end, near);
  near_in_range<true, true>(in, begin, end, near);
}

}  // namespace carom
