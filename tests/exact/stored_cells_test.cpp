// The cells stored for a part of the box: a disk is in one of them wherever it has gone, and a search of the cells
// around it finds it there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/exact/cell_blocks.hpp"
#include "parallel/exact/listed_cells.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

std::uint32_t cell_after(std::uint32_t cell, std::uint32_t steps, std::uint32_t cells) {
  return (cell + steps) % cells;
}

// For any stored cells and any searched cells of the box.
TEST(StoredCells, AreSearchedWhereTheDisksOfACellAre) {
  constexpr std::uint32_t cells = 11;
  for (std::uint32_t count = 1; count + 2 <= cells; ++count) {
    for (std::uint32_t first = 0; first < cells; ++first) {
      const StoredCells stored{first, count};
      for (std::uint32_t from = 0; from < cells; ++from) {
        for (std::uint32_t length = 1; length <= cells; ++length) {
          const Span span = stored_span(stored, cells, {length < cells ? from : 0, length});
          ASSERT_LE(span.first + span.count, count);
          for (std::uint32_t k = 0; k < length; ++k) {
            const std::uint32_t place = stored.place_of(cell_after(from, k, cells), cells);
            ASSERT_TRUE(place >= span.first && place < span.first + span.count)
                << count << " from " << first << ", searched " << length << " from " << from << ", cell " << k;
          }
        }
      }
    }
  }
}

// If all searched cells are stored, only they are searched.
TEST(StoredCells, AreSearchedAloneWhereAllAreStored) {
  const StoredCells stored{7, 6};  // of 10 cells, across the border: 7, 8, 9, 0, 1, 2
  const Span span = stored_span(stored, 10, {8, 4});
  EXPECT_EQ(span.first, 1U);
  EXPECT_EQ(span.count, 4U);
  EXPECT_EQ(stored.place_of(3, 10), 5U) << "the nearest stored cell";
  EXPECT_EQ(stored.place_of(6, 10), 0U);
}

// All cells between two places are stored consecutively, in the rows and columns of each level, and none outside,
// unless all cells are.
TEST(StoredCells, AreThoseBetweenTwoPlaces) {
  for (const test::Periodic along : {test::Periodic::none, test::Periodic::both}) {
    const Domain box = test::box_of(60.0, 40.0, along);
    for (const Vec2 low : {Vec2{-9.0, -7.0}, Vec2{12.3, 11.1}, Vec2{41.0, 27.0}}) {
      const Vec2 high{low.x + 22.0, low.y + 17.0};
      CellGrid grid;
      make_grid(box, 0.5, {600, 600}, grid);
      const CellGrid whole = grid;
      store_cells_between(box, low, high, grid);
      EXPECT_LT(grid.keys, whole.keys / 2);
      std::uint32_t keys = 0;
      for (const GridLevel& level : grid.levels) {
        EXPECT_EQ(level.first_key, keys);
        keys += level.keys();
        const auto check = [&](StoredCells stored, std::uint32_t cells, double from, double to, double side) {
          EXPECT_EQ(stored.count, static_cast<std::uint32_t>(std::floor(to) - std::floor(from)) + 1);
          for (double at = std::floor(from); at <= to; at += 1.0) {
            const double wrapped = at < 0.0 ? at + side : at >= side ? at - side : at;
            EXPECT_EQ(stored.place_of(static_cast<std::uint32_t>(wrapped), cells),
                      static_cast<std::uint32_t>(at - std::floor(from)));
          }
        };
        const bool wraps = along == test::Periodic::both;
        const auto in_cells = [&](double at, double per_length, std::uint32_t cells) {
          return wraps ? at * per_length : std::clamp(at * per_length, 0.0, cells - 1.0);
        };
        check(level.stored_columns, level.columns, in_cells(low.x, level.columns_per_length, level.columns),
              in_cells(high.x, level.columns_per_length, level.columns), level.columns);
        check(level.stored_rows, level.rows, in_cells(low.y, level.rows_per_length, level.rows),
              in_cells(high.y, level.rows_per_length, level.rows), level.rows);
      }
      EXPECT_EQ(grid.keys, keys);
    }
  }
}

// If the quick computation of the places of a search gives a result, it is that of the general one.
TEST(ListedAxis, TellsTheSamePlacesAsStoredSpan) {
  for (const bool periodic : {false, true}) {
    constexpr std::uint32_t cells = 13;
    const StoredCells stored{periodic ? 9U : 4U, 7};
    const ListedAxis axis{cells, periodic ? 32U : 31U, true, stored.first, stored.count};
    const std::uint32_t side = periodic ? 0xffffffffU : 0x80000000U;
    int told = 0;
    for (std::uint32_t k = 0; k <= 400; ++k) {
      const auto at = static_cast<std::uint32_t>(std::uint64_t{side} * k / 400);
      for (const std::uint32_t reach : {side / 100, side / 7, side / 3}) {
        const Span quick = axis.span_around(at, reach);
        if (quick.count == 0) continue;
        const Span span = stored_span(stored, cells, span_around_listed(at, reach, cells, periodic));
        EXPECT_EQ(quick.first, span.first);
        EXPECT_EQ(quick.count, span.count);
        ++told;
      }
      const std::uint32_t place = stored.place_of(cell_of_listed(at, cells, periodic), cells);
      if (axis.place_of(at) < axis.stored) {
        EXPECT_EQ(axis.place_of(at), place);
      }
    }
    EXPECT_GT(told, 100);
  }
}

}  // namespace
}  // namespace carom
