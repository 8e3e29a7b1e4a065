// The cells searched around a place: none is missed because of the last bit, and for cells that are not stored the
// nearest stored ones are taken.
#include "parallel/cells/nearby_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/cells/tiled_grid.hpp"

namespace carom {
namespace {

bool holds(const Span& span, std::uint32_t cell, std::uint32_t cells) {
  return (cell + cells - span.first) % cells < span.count;
}

// A disk just before or behind a border of cells, exactly at the reach from a place on either side: sum and difference
// are rounded by more than the disk's distance from the border.
TEST(SpanAround, HoldsWhatIsExactlyAsFarAwayAsTheReach) {
  constexpr std::uint32_t cells = 30;
  for (const double length : {30.0, 1.0, 77.7}) {
    const double per_length = cells / length;
    for (std::uint32_t k = 5; k < 25; ++k) {
      const double border = k / per_length;
      for (const double x : {std::nextafter(border, 0.0), border, std::nextafter(border, length)}) {
        const std::uint32_t cell = cell_index(x * per_length, cells);
        for (const double reach : {0.1, 0.7, 1.3, 3.1}) {
          const double r = reach * length / cells;
          for (const bool periodic : {false, true}) {
            EXPECT_TRUE(holds(span_around(x + r, r, length, per_length, cells, periodic), cell, cells))
                << k << " " << r;
            EXPECT_TRUE(holds(span_around(x - r, r, length, per_length, cells, periodic), cell, cells))
                << k << " " << r;
          }
        }
      }
    }
  }
}

// If only some groups of tiles are kept, at least two are left out. With a single one, a disk in it could be nearest to
// either end. Rows left out belong to the end that is nearer along the period.
TEST(TilesKept, AreAllOrLeaveTwoGroupsOut) {
  Domain box;
  box.width = 100.0;
  box.height = 100.0;
  box.sides.fill(SideKind::periodic);
  for (double high = 1.0; high < 100.0; high += 1.0) {
    CellGrid grid;
    make_tiled_grid(box, 0.5, {4000}, 64, 4, grid);
    const std::uint32_t group = 1U << grid.levels[0].group_shift;
    keep_tiles_between(box, 0.0, high, grid);
    const GridLevel& level = grid.levels[0];
    if (level.stored_rows.count >= level.rows) continue;
    EXPECT_LE(level.stored_rows.count + 2 * group, level.rows) << high;
    const std::uint32_t first = level.stored_rows.first, last = first + level.stored_rows.count - 1;
    for (std::uint32_t row = 0; row < level.rows; ++row) {
      const std::uint32_t place = level.stored_rows.place_of(row, level.rows);
      const std::uint32_t beyond = (row + level.rows - last) % level.rows;  // rows after the last one
      const std::uint32_t before = (first + level.rows - row) % level.rows;
      if (row >= first && row <= last) {
        EXPECT_EQ(place, row - first);
      } else if (beyond < before) {
        EXPECT_EQ(place, level.stored_rows.count - 1) << row << " of " << level.rows;
      } else if (before < beyond) {
        EXPECT_EQ(place, 0U) << row << " of " << level.rows;
      }
    }
  }
}

// Each kept cell has its own key, and the tiles of a layer follow each other in memory, whether all tiles are kept or
// only some.
void expect_own_keys(const CellGrid& grid, bool wide) {
  std::vector<char> seen(grid.keys, 0);
  for (const GridLevel& level : grid.levels) {
    const std::uint32_t stored = std::min(level.rows, level.stored_rows.count);
    for (std::uint32_t place = 0; place < stored; ++place) {
      for (std::uint32_t column = 0; column < level.columns; ++column) {
        const std::uint32_t key = level.key_at(place, column);
        ASSERT_LT(key, grid.keys);
        ASSERT_EQ(seen[key]++, 0) << "row " << place << ", column " << column;
        const std::uint32_t layer = wide ? column >> level.band_shift : place >> level.group_shift;
        ASSERT_EQ(key / grid.tile_keys / grid.tiles_a_layer, layer);
      }
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), 0) << "some keys belong to no cell";
}

TEST(TilesKept, HaveAKeyOfItsOwnForEachCell) {
  for (const auto& [width, height] : {std::pair{40.0, 100.0}, std::pair{100.0, 40.0}, std::pair{60.0, 60.0}}) {
    for (const std::vector<std::size_t>& count :
         {std::vector<std::size_t>{4000}, std::vector<std::size_t>{500, 6000}}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << count.size() << " classes");
      Domain box{width, height};
      CellGrid grid;
      make_tiled_grid(box, 0.5, count, 64, 4, grid);
      ASSERT_GT(grid.tiles_a_layer, 1U);
      expect_own_keys(grid, width >= height);
      const std::uint32_t tiles = grid.tiles;
      keep_tiles_between(box, 0.3 * height, 0.5 * height, grid);
      ASSERT_LT(grid.tiles, tiles);
      expect_own_keys(grid, width >= height);
    }
  }
}

// Is this the place of the cell, or, if it is not stored, of the end that is nearer across the period (either one if
// they are equally near)?
bool is_nearest(const StoredCells& stored, std::uint32_t place, std::uint32_t cell, std::uint32_t cells) {
  const std::uint32_t after_first = (cell + cells - stored.first) % cells;
  if (after_first < stored.count) return place == after_first;
  const std::uint32_t beyond_last = after_first - (stored.count - 1);
  const std::uint32_t before_first = cells - after_first;
  return (place == 0 && before_first <= beyond_last + 1) ||
         (place == stored.count - 1 && beyond_last <= before_first + 1);
}

// Each stored cell has its own key, and cells elsewhere map to the nearest one, for a rectangle in the middle of the
// box and across its sides.
TEST(CellsStored, AreThoseOfTheRectangle) {
  for (const SideKind kind : {SideKind::periodic, SideKind::wall}) {
    for (const Vec2 low : {Vec2{20.0, 30.0}, Vec2{-11.0, 55.0}, Vec2{71.0, -5.0}}) {
      Domain box{100.0, 80.0};
      box.sides.fill(kind);
      CellGrid grid = make_grid(box, 0.5, {3000});
      store_cells_between(box, low, {low.x + 40.0, low.y + 30.0}, grid);
      const GridLevel& level = grid.levels[0];
      ASSERT_LT(level.stored_rows.count, level.rows);
      ASSERT_LT(level.stored_columns.count, level.columns);
      std::vector<char> seen(grid.keys, 0);
      for (std::uint32_t row = 0; row < level.rows; ++row) {
        for (std::uint32_t column = 0; column < level.columns; ++column) {
          const std::uint32_t key = level.stored_key(row, column);
          ASSERT_LT(key, grid.keys);
          seen[key] = 1;
          EXPECT_TRUE(is_nearest(level.stored_rows, key / level.stride, row, level.rows)) << row;
          EXPECT_TRUE(is_nearest(level.stored_columns, key % level.stride, column, level.columns)) << column;
        }
      }
      EXPECT_EQ(static_cast<std::uint32_t>(std::count(seen.begin(), seen.end(), 1)),
                level.stored_rows.count * level.stored_columns.count);
    }
  }
}

}  // namespace
}  // namespace carom
