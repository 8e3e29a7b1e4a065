// The crowding of disks, compared with densities that follow from how they were placed.
#include "parallel/cells/crowding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "parallel/cells/cell_grid.hpp"
#include "parallel/stepping/stepping_cells.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

template <class Place>
Disks placed(std::size_t n, Place&& place) {
  Disks d;
  d.common_radius = 0.5;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 at = place(i);
    d.x.push_back(at.x);
    d.y.push_back(at.y);
  }
  return d;
}

// Counted by hand: 64 disks share one of four cells and have more than 40 others each, so there are sixteen cells. Two
// of these have 32 disks each, with 31 others; in a uniform box a disk would have 64 / 16 = 4.
TEST(Crowding, CountsTheOthersOfADisk) {
  const Disks d = placed(64, [](std::size_t i) {
    return Vec2{i % 2 == 0 ? 5.0 : 15.0, 2.0 + 0.1 * static_cast<double>(i)};
  });
  EXPECT_EQ(crowding(d, test::box_of(40.0, 40.0), d.size()), 31.0 / 4.0);
}

TEST(Crowding, AGasThatFillsTheBoxIsNotCrowded) {
  for (const std::size_t n : {std::size_t{41}, std::size_t{300}, std::size_t{2000}, std::size_t{100'000}}) {
    for (const double aspect : {1.0, 100.0, 0.01, 1e6, 1e-6, 1e9}) {
      test::Draws draws(n);
      const Domain box = test::box_of(50.0 * aspect, 50.0);
      EXPECT_EQ(crowding(placed(n,
                                [&](std::size_t) {
                                  return Vec2{draws.in(0.0, box.width), draws.in(0.0, 50.0)};
                                }),
                         box),
                1.0)
          << n << " disks, aspect " << aspect;
    }
  }
  const auto on_lattice = [](std::size_t i) {
    return Vec2{static_cast<double>(i % 60) + 0.5, static_cast<double>(i / 60) + 0.5};
  };
  EXPECT_EQ(crowding(placed(3600, on_lattice), test::box_of(60.0, 60.0)), 1.0);
}

TEST(Crowding, FewDisksAreNotCrowded) {
  EXPECT_EQ(crowding({}, test::box_of(1e6, 1.0)), 1.0);
  EXPECT_EQ(crowding(placed(1, [](std::size_t) { return Vec2{}; }), test::box_of(1e6, 1e6)), 1.0);
}

// Disks that occupy a share s of the box are 1 / s times as dense as the mean.
TEST(Crowding, DisksInAShareOfTheBoxAreDenserByThatShare) {
  for (const std::size_t n : {std::size_t{400}, std::size_t{20'000}, std::size_t{200'000}}) {
    for (const double share : {0.2, 1e-2, 1e-4}) {
      test::Draws draws(n);
      const double height = 1e6;
      const auto pile = [&](std::size_t) { return Vec2{draws.in(0.0, 30.0), draws.in(0.0, share * height)}; };
      EXPECT_NEAR(crowding(placed(n, pile), test::box_of(30.0, height)) * share, 1.0, 0.15)
          << n << " disks at the bottom";
      const double side = std::sqrt(share) * 1e4;
      const auto cluster = [&](std::size_t) { return Vec2{5e3 + draws.in(0.0, side), 2e3 + draws.in(0.0, side)}; };
      EXPECT_NEAR(crowding(placed(n, cluster), test::box_of(1e4, 1e4)) * share, 1.0, 0.15) << n << " disks in a square";
    }
  }
}

// n(y) = exp(-y / l) / l, averaged over the disks: the integral of n^2 is 1 / 2 l, divided by the mean density 1 / h.
TEST(Crowding, OfAnAtmosphereIsHalfTheHeightInScaleHeights) {
  test::Draws draws(5);
  const Domain box = test::box_of(40.0, 1000.0);
  const auto atmosphere = [&](std::size_t) {
    return Vec2{draws.in(0.0, 40.0), std::min(1000.0, -10.0 * std::log(draws.in(0x1p-53, 1.0)))};
  };
  EXPECT_NEAR(crowding(placed(20'000, atmosphere), box), 50.0, 5.0);
}

TEST(Crowding, SomeOfTheDisksTellWhereTheyAreAllOverThatPart) {
  test::Draws draws(6);
  const Domain box = test::box_of(100.0, 100.0);
  const Disks lower = placed(10'000, [&](std::size_t) { return Vec2{draws.in(0.0, 100.0), draws.in(0.0, 50.0)}; });
  EXPECT_NEAR(crowding(lower, box), 2.0, 0.1);
  EXPECT_EQ(crowding(lower, box, 20'000), 1.0);
}

// The cells of a pile in a tall box have as few disks as in a box that the pile fills.
TEST(Crowding, GivesCellsToDisksWhereTheyAre) {
  test::Draws draws(7);
  constexpr std::size_t n = 2000;
  const Domain box = test::box_of(50.0, 2000.0);
  const Disks pile = placed(n, [&](std::size_t) { return Vec2{draws.in(0.0, 50.0), draws.in(0.0, 50.0)}; });
  CellGrid grid;
  make_grid(box, 0.5, {n}, grid, grid_margin, crowding(pile, box));
  std::vector<int> held(grid.keys);
  for (std::size_t i = 0; i < n; ++i) ++held[key_of(grid.levels[0], pile.x[i], pile.y[i])];
  EXPECT_LE(*std::max_element(held.begin(), held.end()), 12);
  EXPECT_LT(grid.keys, 200 * n);
}

// Each sort visits all cells, so time stepping uses fewer: they have somewhat more disks, and their number grows less
// than the ratio of the heights of box and pile.
TEST(Crowding, GivesTimeSteppingFewerCells) {
  test::Draws draws(8);
  constexpr std::size_t n = 2000;
  for (const double height : {2000.0, 5000.0, 1e5}) {
    const Domain box = test::box_of(50.0, height);
    const Disks pile = placed(n, [&](std::size_t) { return Vec2{draws.in(0.0, 50.0), draws.in(0.0, 50.0)}; });
    std::vector<std::size_t> count;
    CellGrid grid;
    make_stepping_cells(pile, box, count, grid);
    std::vector<std::size_t> held(grid.keys);
    for (std::size_t i = 0; i < n; ++i) ++held[key_of(grid.levels[0], pile.x[i], pile.y[i])];
    const double higher = height / 50.0;
    EXPECT_LE(*std::max_element(held.begin(), held.end()), std::sqrt(higher) + 12.0) << height;
    EXPECT_LT(grid.keys, 5.0 * std::sqrt(higher) * n) << height;
  }
}

}  // namespace
}  // namespace carom
