// Which cells are searched around a place: none is missed by the last bit, and those that are stored are the nearest.
#include "parallel/cells/nearby_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "parallel/cells/tiled_grid.hpp"

namespace carom {
namespace {

bool holds(const Span& span, std::uint32_t cell, std::uint32_t cells) {
  return (cell + cells - span.first) % cells < span.count;
}

// A disk just before a border, and one just behind it, exactly as far away as the reach, on either side of a place: the
// sum and the difference are rounded by more than the disk is off the border.
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

// Where only some groups of tiles are kept, two at least are left out: with one alone, a disk that has come into it
// could be nearest to either end. Its rows go to the end that is nearer along the period.
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
      const std::uint32_t beyond = (row + level.rows - last) % level.rows;  // rows after the last
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

}  // namespace
}  // namespace carom
