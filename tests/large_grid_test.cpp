// Grids for 10^9 disks: their keys, which have 32 bits, count every cell. No disk is made, so no memory is needed.
#include <gtest/gtest.h>

#include <cmath>

#include "parallel/cell_grid.hpp"

namespace carom {
namespace {

constexpr std::size_t disks = 1'000'000'000;

// The keys of a level counted in 64 bits.
std::uint64_t keys_of(const GridLevel& level) {
  const std::uint64_t bands = (level.columns - 1) >> level.band_shift;
  return bands * (std::uint64_t{level.rows} * level.stride) + (std::uint64_t{level.rows} + 1) * level.stride + 2;
}

void expect_counted(const Domain& box, double radius, const std::vector<std::size_t>& count, unsigned band_shift) {
  CellGrid grid;
  make_grid(box, radius, count, grid, band_shift);
  std::uint64_t keys = 0;
  for (const GridLevel& level : grid.levels) {
    EXPECT_EQ(level.first_key, keys);
    keys += keys_of(level);
  }
  EXPECT_EQ(grid.keys, keys) << box.width << " x " << box.height << ", bands of 2^" << band_shift;
  const GridLevel& last = grid.levels.back();
  EXPECT_LT(key_of(last, box.width, box.height), grid.keys);
  EXPECT_GT(key_of(last, box.width, box.height), grid.keys / 4) << "the far corner is no small number";
}

TEST(LargeGrid, KeysCountTheCellsOfABillionDisks) {
  // Dense and loose, square, long and high; one radius, and two classes of half the disks each.
  for (const double side : {4e4, 1e6}) {
    for (const double aspect : {1.0, 1e-4, 1e4}) {
      Domain box;
      box.width = side * std::sqrt(aspect);
      box.height = side / std::sqrt(aspect);
      for (const unsigned band_shift : {31U, 5U}) {
        expect_counted(box, 0.5, {disks}, band_shift);
        expect_counted(box, 0.5, {disks / 2, disks / 2}, band_shift);
      }
    }
  }
}

}  // namespace
}  // namespace carom
