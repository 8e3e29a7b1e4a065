// The test whether two disks touch, and the search between two size classes. Included by find_contacts.cpp only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/disks/pair.hpp"
#include "core/physics/disk_pair.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/stepping/coarse_eight.inl"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/search_kernel.hpp"

namespace carom {

namespace {

// The magnitude of nearest_image(d, period), with the same bits and without a branch, which would be hard to predict.
// Beyond half a period the subtraction is exact.
double nearest_magnitude(double d, double period) {
  return std::min(std::abs(d), period - std::abs(d));
}

double contact_distance(const SearchInput& in, std::size_t i, std::size_t j) {
  return in.radius == nullptr ? in.common_radius + in.common_radius : in.radius[j] + in.radius[i];
}

// sheared, here and below: is the box sheared? find_contacts chooses once.
template <bool sheared>
bool touch(const SearchInput& in, std::size_t i, std::size_t j) {
  if constexpr (sheared) {
    return touches(nearest_distance2({in.x[j] - in.x[i], in.y[j] - in.y[i]}, in.box), contact_distance(in, i, j));
  } else {
    const double dx = nearest_magnitude(in.x[j] - in.x[i], in.period_x);
    const double dy = nearest_magnitude(in.y[j] - in.y[i], in.period_y);
    return touches(dx * dx + dy * dy, contact_distance(in, i, j));
  }
}

// The search around disks of one size class for those of another, which are all stored after them (`after`), or all
// before them. sheared: is the box sheared?
template <bool sheared>
class AcrossSearch {
 public:
  AcrossSearch(const SearchInput& in, const GridLevel& other, bool after)
      : in_(in),
        other_(other),
        after_(after),
        reach_(other.largest_radius + other.margin),
        units_per_length_(1.0 / coarse_unit(other)),
        most_in_nine_cells_(std::min(other.cell_width, other.cell_height) - reach_ -
                            span_rounding * std::max(in.box.width, in.box.height)),
        most_coarse_(coarse_unit(other) * most_units) {}

  // Pairs of disk i.
  void operator()(std::size_t i, std::vector<Pair>& pairs) const {
    const std::uint32_t row = row_at(other_, in_.y[i]);
    const std::uint32_t column = cell_index(in_.x[i] * other_.columns_per_length, other_.columns);
    // All eight neighbours of the cell exist, none of them across a periodic side. (With one or two cells that never
    // holds.)
    const bool inside = column - 1U < other_.columns - 2U && row - 1U < other_.rows - 2U && other_.has_row(row - 1) &&
                        other_.has_row(row + 1);
    if (inside && in_.radius[i] < most_in_nine_cells_) return in_nine_cells(i, row, column, pairs);
    const double reach = in_.radius[i] + reach_;
    const bool coarse = is_coarse_enough(i, reach);
    const CoarseDisk disk = coarse_disk(i);
    for_each_run_near(other_, in_.start, in_.box, in_.x[i], in_.y[i], reach, [&](auto first, auto last) {
      if (coarse) return test_near(i, disk, first, last, pairs);
      for (std::uint32_t j = first; j < last; ++j) test(i, j, pairs);
    });
  }

 private:
  // With at most this many units the sum of two radii has 15 bits.
  static constexpr double most_units = 0x1p14;

  // A disk in the coarse units of the other level; the same in all lanes.
  struct CoarseDisk {
    Eight place, reach;
  };
  CoarseDisk coarse_disk(std::size_t i) const {
    constexpr double rounding = 0x1.8p52;  // the nearest whole number is then in the lowest bits
    const auto bits = [&](double c) { return __builtin_bit_cast(std::uint64_t, c * units_per_length_ + rounding); };
    const auto radius = static_cast<std::uint32_t>(in_.radius[i] * units_per_length_) + 1U;
    return {all(static_cast<std::uint32_t>((bits(in_.x[i]) & 0xffffU) | (bits(in_.y[i]) << 16U))),
            all(radius + coarse_radius_error)};
  }

  // Can coarse positions be used for disk i? Not near periodic sides, and not if it is so large that distances do not
  // fit in 16 bits.
  bool is_coarse_enough(std::size_t i, double reach) const {
    const auto has_images = [&](double c, double length, bool periodic) {
      return periodic && (c < reach || c + reach >= length);
    };
    return in_.radius[i] < most_coarse_ && !has_images(in_.x[i], in_.box.width, in_.box.periodic_x()) &&
           !has_images(in_.y[i], in_.box.height, in_.box.periodic_y());
  }

  // Which of the disks first .. first + 7 may touch the disk.
  Eight may_touch(const CoarseDisk& disk, std::uint32_t first) const {
    const Eight distance2 = squared(difference(disk.place, load(in_.position + first)));
    return exceeds(squared(sum(disk.reach, load(in_.coarse_radius + first))), distance2);
  }

  // A run of three cells usually has fewer than eight disks, and usually none of them touches.
  void in_nine_cells(std::size_t i, std::uint32_t row, std::uint32_t column, std::vector<Pair>& pairs) const {
    const std::uint32_t* const below = in_.start + (other_.first_key + (row - 1) * other_.stride + column - 1);
    const std::uint32_t* const own = below + other_.stride;
    const std::uint32_t* const above = own + other_.stride;
    const CoarseDisk disk = coarse_disk(i);
    const Eight near = either(either(may_touch(disk, below[0]), may_touch(disk, own[0])), may_touch(disk, above[0]));
    const std::uint32_t longest = std::max({below[3] - below[0], own[3] - own[0], above[3] - above[0]});
    if (bits_of(near) == 0 && longest <= lanes) [[likely]]
      return;
    for (const std::uint32_t* run : {below, own, above}) test_near(i, disk, run[0], run[3], pairs);
  }

  void test_near(std::size_t i, const CoarseDisk& disk, std::uint32_t first, std::uint32_t last,
                 std::vector<Pair>& pairs) const {
    for (; first < last; first += lanes) {
      for (unsigned bits = bits_of(may_touch(disk, first)); bits != 0; bits &= bits - 1) {
        const std::uint32_t j = first + static_cast<unsigned>(__builtin_ctz(bits));
        if (j < last) test(i, j, pairs);
      }
    }
  }

  void test(std::size_t i, std::uint32_t j, std::vector<Pair>& pairs) const {
    const auto own = static_cast<std::uint32_t>(i);
    const Pair pair = after_ ? Pair{own, j} : Pair{j, own};
    if (touch<sheared>(in_, pair.i1, pair.i2)) [[unlikely]]
      pairs.push_back(pair);
  }

  const SearchInput& in_;
  const GridLevel& other_;
  bool after_;
  double reach_;             // search distance beyond the radius of the searching disk; length
  double units_per_length_;  // of the other level's coarse positions
  // Disks of smaller radii find all neighbours in their cell and the eight around it, and have distances that fit in 16
  // bits, respectively.
  double most_in_nine_cells_, most_coarse_;  // length
};

}  // namespace

}  // namespace carom
