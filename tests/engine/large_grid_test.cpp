// Grids for 10^9 disks: their keys, of 32 bits, are enough for every cell. No disks are made, so little memory is
// needed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/tiled_grid.hpp"

namespace carom {
namespace {

constexpr std::size_t disks = 1'000'000'000;

void expect_in_corner(const CellGrid& grid, const Domain& box) {
  const GridLevel& last = grid.levels.back();
  EXPECT_LT(key_of(last, box.width, box.height), grid.keys);
  EXPECT_GT(key_of(last, box.width, box.height), grid.keys / 4) << "the key of the far corner has overflowed";
}

// The number of keys is compared with a count in 64 bits.
void expect_counted(const Domain& box, double radius, const std::vector<std::size_t>& count) {
  CellGrid grid;
  make_grid(box, radius, count, grid);
  std::uint64_t keys = 0;
  for (const GridLevel& level : grid.levels) {
    EXPECT_EQ(level.first_key, keys);
    keys += (std::uint64_t{level.rows} + 1) * level.stride + 2;
  }
  EXPECT_EQ(grid.keys, keys) << box.width << " x " << box.height;
  expect_in_corner(grid, box);
}

void expect_counted_in_tiles(const Domain& box, double radius, const std::vector<std::size_t>& count) {
  CellGrid grid;
  make_tiled_grid(box, radius, count, 8192, 2, grid);
  std::uint64_t cells = 0;
  for (const GridLevel& level : grid.levels) {
    cells += std::uint64_t{level.rows} * level.columns;
    EXPECT_EQ(level.columns % level.stride, 0U);
  }
  EXPECT_EQ(grid.keys, cells) << box.width << " x " << box.height;
  EXPECT_EQ(std::uint64_t{grid.tiles} * grid.tile_keys, cells);
  EXPECT_LE(grid.tiles, 0xffffU) << "a tile's number has 16 bits";
  expect_in_corner(grid, box);
}

// Kernels read keys as signed numbers, so they must have at most 31 bits.
TEST(LargeGrid, KeysOfTheMostDisksHave31Bits) {
  constexpr std::size_t most = 4'000'000'000;
  for (const double aspect : {1.0, 1e-12, 1e12}) {
    Domain box;
    box.width = 1e6 * std::sqrt(aspect);
    box.height = 1e6 / std::sqrt(aspect);
    for (const std::vector<std::size_t>& count :
         {std::vector{most}, std::vector{most / 4, most / 4, most / 4, most / 4}}) {
      const CellGrid grid = make_grid(box, 1e-7, count);
      std::uint64_t keys = 0;
      for (const GridLevel& level : grid.levels) keys += (std::uint64_t{level.rows} + 1) * level.stride + 2;
      EXPECT_LT(keys, std::uint64_t{1} << 31U) << aspect;
      EXPECT_GT(keys, std::uint64_t{1} << 29U) << aspect;
      EXPECT_EQ(grid.keys, keys);
    }
  }
}

TEST(LargeGrid, KeysCountTheCellsOfABillionDisks) {
  // Dense and dilute systems in square, long and high boxes; one radius, and two classes with half of the disks each.
  for (const double side : {4e4, 1e6}) {
    for (const double aspect : {1.0, 1e-4, 1e4}) {
      Domain box;
      box.width = side * std::sqrt(aspect);
      box.height = side / std::sqrt(aspect);
      for (const std::vector<std::size_t>& count : {std::vector{disks}, std::vector{disks / 2, disks / 2}}) {
        expect_counted(box, 0.5, count);
        expect_counted_in_tiles(box, 0.5, count);
      }
    }
  }
}

// A channel as wide as one disk.
TEST(LargeGrid, TilesOfANarrowBoxAreNoMoreThan16BitsNumber) {
  for (const double aspect : {1e6, 1e9, 1e-6, 1e-9}) {
    for (const std::size_t all : {std::size_t{100'000}, std::size_t{5'000'000}, disks}) {
      Domain box;
      box.width = 1e3 * std::sqrt(aspect);
      box.height = 1e3 / std::sqrt(aspect);
      for (const std::size_t regions : {std::size_t{1}, std::size_t{2}, std::size_t{64}}) {
        CellGrid grid;
        make_tiled_grid(box, 1e-4, {all}, 8192, regions, grid);
        EXPECT_LE(grid.tiles, 0xffffU) << aspect << ", " << all << " disks";
        EXPECT_LE(static_cast<double>(all) / grid.keys, 8.0) << aspect << ", " << all << " disks";
      }
    }
  }
}

// If rounding decided on the number of cells of a tile, a power of two, cells could have 3.5 disks or 7; they have room
// for eight.
TEST(LargeGrid, CellsOfEvenTilesHoldAsManyDisksWhateverTheirNumber) {
  for (std::size_t all = 1'000'000; all < 3'000'000'000; all += all / 7) {
    Domain box;
    box.width = box.height = 1e4;
    CellGrid grid;
    const std::size_t tile = even_tile(8192, all);
    make_tiled_grid(box, 0.001, {all}, tile, 1, grid);
    const double disks_a_cell = static_cast<double>(all) / grid.keys;
    EXPECT_GT(disks_a_cell, 5.4) << all;
    EXPECT_LT(disks_a_cell, 8.0) << all;
    EXPECT_LE(grid.tiles, 0xffffU);
    if (all < 200'000'000) {
      EXPECT_LE(tile, 8192U);
    }
  }
}

}  // namespace
}  // namespace carom
