// The grid search compared with a test of all pairs, for boxes and radii with which the original's grid
// (docs/original.md) fails.
#include "core/reference/pair_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/support/all_pairs.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

using test::box_of;
using test::Periodic;
using test::periodic_along;

// Both must find the same pairs in the same order, each once, with the smaller id first. Returns their number.
std::size_t expect_same(const Disks& disks, const Domain& box) {
  const std::vector<Pair> grid = find_touching_pairs(disks, box);
  EXPECT_EQ(grid, test::touching_among_all_pairs(disks, box));
  for (std::size_t k = 0; k < grid.size(); ++k) {
    EXPECT_LT(disks.id[grid[k].i1], disks.id[grid[k].i2]);
    EXPECT_TRUE(k == 0 || !(grid[k] == grid[k - 1]));  // F14: no pair may occur twice
  }
  std::vector<Pair> looked_at;
  deepest_of_touching_pairs(disks, box, run_in_order, [&](std::uint32_t i, std::uint32_t j) {
    looked_at.push_back({i, j});
    return 0.0;
  });
  const auto ids = [&](const Pair& p) { return std::pair(disks.id[p.i1], disks.id[p.i2]); };
  std::sort(looked_at.begin(), looked_at.end(), [&](const Pair& a, const Pair& b) { return ids(a) < ids(b); });
  EXPECT_EQ(looked_at, grid);
  return grid.size();
}

// Disks anywhere, which may overlap; centres may lie up to `outside` beyond walls.
Disks anywhere(test::Draws& draws, const Domain& box, std::size_t n, double radius_low, double radius_high,
               double outside = 0.0) {
  const double ox = box.periodic_x() ? 0.0 : outside;
  const double oy = box.periodic_y() ? 0.0 : outside;
  std::vector<Disk> list(n);
  for (Disk& d : list) {
    d.radius = draws.decades(radius_low, radius_high);
    d.mass = 1.0;
    d.x = draws.in(-ox, box.width + ox);
    d.y = draws.in(-oy, box.height + oy);
  }
  return test::disks_of(list);
}

TEST(PairSearch, AgreesWithAllPairsInBoxesOfAnyKind) {
  test::Draws draws(1);
  for (int sides = 0; sides < 4; ++sides) {
    for (int k = 0; k < 12; ++k) {
      const Domain box =
          box_of(draws.decades(2.0, 200.0), draws.decades(2.0, 200.0), periodic_along(sides % 2 == 1, sides / 2 == 1));
      expect_same(anywhere(draws, box, 150, 0.5, 0.5000001), box);
      expect_same(anywhere(draws, box, 150, 0.1, 2.0, 0.7), box);
    }
  }
}

// F6, F17: disks wider than many cells, with radii 1 : 1000.
TEST(PairSearch, RadiiOfAllSizes) {
  test::Draws draws(2);
  for (int k = 0; k < 8; ++k) {
    const Domain box = box_of(100.0, 80.0, periodic_along(k % 2 == 1, k / 2 % 2 == 1));
    EXPECT_GT(expect_same(anywhere(draws, box, 300, 0.02, 20.0), box), 0U);
  }
}

// In a sheared box disks of any column may meet across the top and bottom; images are the nearest ones below half the
// height.
TEST(PairSearch, ShearedImages) {
  test::Draws draws(6);
  Domain box = box_of(60.0, 50.0, Periodic::both);
  box.shear.rate = 1.0;
  for (int k = 0; k < 8; ++k) {
    box.shear.offset = draws.in(-0.5 * box.width, 0.5 * box.width);
    EXPECT_GT(expect_same(anywhere(draws, box, 400, 0.02, 10.0), box), 0U);
    EXPECT_GT(expect_same(anywhere(draws, box, 400, 0.5, 1.0), box), 0U);
  }
}

// F13: centres and edges of disks exactly on cell borders, including corners of the box.
TEST(PairSearch, DisksOnCellEdgesAndCorners) {
  for (int sides = 0; sides < 4; ++sides) {
    const Domain box = box_of(16.0, 16.0, periodic_along(sides % 2 == 1, sides / 2 == 1));
    std::vector<Disk> list;
    for (int ix = 0; ix <= 16; ++ix) {
      for (int iy = 0; iy <= 16; ++iy) {
        if (box.periodic_x() && ix == 16) continue;
        if (box.periodic_y() && iy == 16) continue;
        list.push_back({1.0 * ix, 1.0 * iy, 0.0, 0.0, 0.5, 1.0});
      }
    }
    const std::size_t n_x = box.periodic_x() ? 16 : 17;
    const std::size_t n_y = box.periodic_y() ? 16 : 17;
    const std::size_t links_x = 16 * n_y;  // an open row of n + 1 disks has n contacts, and so has a closed row of n
    const std::size_t links_y = 16 * n_x;
    EXPECT_EQ(expect_same(test::disks_of(list), box), links_x + links_y);
  }
}

// F7: disks that reach over a wall, or were pushed wholly outside.
TEST(PairSearch, CentresOutsideTheWalls) {
  test::Draws draws(3);
  const Domain box = box_of(20.0, 20.0);
  for (int k = 0; k < 10; ++k) expect_same(anywhere(draws, box, 200, 0.5, 1.5, 5.0), box);
  const Disks corner = test::disks_of({{-1.0, -1.0, 0, 0, 1.0, 1.0}, {-2.5, -1.0, 0, 0, 1.0, 1.0}});
  EXPECT_EQ(expect_same(corner, box), 1U);
}

// F10: pairs across each periodic side and across the corner.
TEST(PairSearch, AcrossPeriodicSides) {
  const std::vector<Disk> row{{0.5, 5.0, 0, 0, 1.0, 1.0}, {9.0, 5.0, 0, 0, 1.0, 1.0}};
  EXPECT_EQ(expect_same(test::disks_of(row), box_of(10.0, 10.0, Periodic::x)), 1U);
  EXPECT_EQ(expect_same(test::disks_of(row), box_of(10.0, 10.0, Periodic::y)), 0U);
  const std::vector<Disk> column{{5.0, 0.5, 0, 0, 1.0, 1.0}, {5.0, 9.0, 0, 0, 1.0, 1.0}};
  EXPECT_EQ(expect_same(test::disks_of(column), box_of(10.0, 10.0, Periodic::y)), 1U);
  const std::vector<Disk> corner{{0.5, 0.5, 0, 0, 1.0, 1.0}, {9.4, 9.4, 0, 0, 1.0, 1.0}};
  EXPECT_EQ(expect_same(test::disks_of(corner), box_of(10.0, 10.0, Periodic::both)), 1U);
  EXPECT_EQ(expect_same(test::disks_of(corner), box_of(10.0, 10.0, Periodic::x)), 0U);
}

// Boxes with one, two or three cells a side: then a neighbour across the corner may be in the same cell.
TEST(PairSearch, FewCells) {
  test::Draws draws(4);
  for (double side : {2.01, 3.9, 4.1, 5.9, 6.1, 8.1}) {
    for (int sides = 0; sides < 4; ++sides) {
      const Domain box = box_of(side, 9.0 - 0.5 * side, periodic_along(sides % 2 == 1, sides / 2 == 1));
      expect_same(anywhere(draws, box, 40, 0.3, 1.0, 0.2), box);
      const Domain narrow = box_of(500.0, 2.0 + 0.01 * side, periodic_along(sides % 2 == 1, sides / 2 == 1));
      expect_same(anywhere(draws, narrow, 300, 0.9, 1.0), narrow);
    }
  }
}

TEST(PairSearch, NoDisksAndOneDisk) {
  const Domain box = box_of(10.0, 10.0, Periodic::both);
  EXPECT_EQ(expect_same({}, box), 0U);
  EXPECT_EQ(expect_same(test::disks_of({{1.0, 1.0, 0, 0, 5.0, 1.0}}), box), 0U);
}

// The pairs found are in order of ids, whatever the order of storage.
TEST(PairSearch, StorageOrderDoesNotMatter) {
  test::Draws draws(5);
  const Domain box = box_of(30.0, 30.0, Periodic::x);
  const Disks disks = anywhere(draws, box, 200, 0.5, 2.0);
  Disks mixed;
  std::vector<std::size_t> order(disks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[draws.bits() % (i + 1)]);
  for (std::size_t i : order) append(mixed, disk_at(disks, i));
  const auto ids = [](const Disks& d, const std::vector<Pair>& pairs) {
    std::vector<std::pair<DiskId, DiskId>> list;
    for (const Pair& p : pairs) list.emplace_back(d.id[p.i1], d.id[p.i2]);
    return list;
  };
  EXPECT_EQ(ids(disks, find_touching_pairs(disks, box)), ids(mixed, find_touching_pairs(mixed, box)));
  expect_same(mixed, box);
}

}  // namespace
}  // namespace carom
