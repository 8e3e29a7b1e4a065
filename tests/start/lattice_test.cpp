#include "core/start/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

using test::box_of;
using test::Draws;
using test::Periodic;
using test::periodic_along;

// The least distance of two sites, including images; infinite for a single site.
double least_distance(const Domain& box, const std::vector<Vec2>& sites) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = i + 1; j < sites.size(); ++j) {
      double dx = sites[j].x - sites[i].x;
      double dy = sites[j].y - sites[i].y;
      if (box.periodic_x()) dx = nearest_image(dx, box.width);
      if (box.periodic_y()) dy = nearest_image(dy, box.height);
      least = std::min(least, std::sqrt(dx * dx + dy * dy));
    }
  }
  return least;
}

std::vector<Vec2> sites_of(const Lattice& lattice, Count count) {
  std::vector<Vec2> sites;
  for (Count k = 0; k < count; ++k) sites.push_back(lattice_site(lattice, k, count));
  return sites;
}

// Disks of this diameter on the sites neither overlap nor leave the box, up to rounding.
void expect_sound(const Domain& box, const Lattice& lattice, Count count, double diameter) {
  const double slack = 1e-11 * (box.width + box.height);
  const std::vector<Vec2> sites = sites_of(lattice, count);
  EXPECT_GE(least_distance(box, sites), diameter - slack);
  const double from_x = box.periodic_x() ? 0.0 : 0.5 * diameter;
  const double from_y = box.periodic_y() ? 0.0 : 0.5 * diameter;
  for (const Vec2& s : sites) {
    EXPECT_GE(s.x, from_x - slack);
    EXPECT_LE(s.x, box.width - from_x + slack);
    EXPECT_GE(s.y, from_y - slack);
    EXPECT_LE(s.y, box.height - from_y + slack);
  }
}

TEST(SquareLattice, FillsASquareEvenly) {
  const auto lattice = square_lattice(box_of(10, 10), 100, 1.0);
  ASSERT_TRUE(lattice.has_value());
  EXPECT_EQ(lattice->columns, 10U);
  EXPECT_EQ(lattice->rows, 10U);
  EXPECT_EQ(lattice_site(*lattice, 0, 100), (Vec2{0.5, 0.5}));
  EXPECT_EQ(lattice_site(*lattice, 99, 100), (Vec2{9.5, 9.5}));
  EXPECT_FALSE(square_lattice(box_of(10, 10), 101, 1.0).has_value());
  EXPECT_EQ(square_capacity(box_of(10, 10, Periodic::both), 1.0), 100U);
}

// With fewer disks than sites disk k is on site floor(k sites / disks), so that no end of the box stays empty.
TEST(SquareLattice, SpreadsFewDisksOverAllSites) {
  const Lattice nine{3, 3, 1.0, 1.0, 0.5, 0.5, 0.0};
  const std::vector<Vec2> four = sites_of(nine, 4);
  EXPECT_EQ(four, (std::vector<Vec2>{{0.5, 0.5}, {2.5, 0.5}, {1.5, 1.5}, {0.5, 2.5}})) << "sites 0, 2, 4, 6";
}

TEST(SquareLattice, CountsDiametersUpToRounding) {
  EXPECT_EQ(square_capacity(box_of(0.3, 0.3), 0.1), 9U) << "0.3 / 0.1 is below 3 in doubles";
}

TEST(HexagonalLattice, IsRegularInAFittingBox) {
  const double height = 10.0 * std::sqrt(3.0) / 2.0;
  const Domain box = box_of(10, height, Periodic::both);
  const auto lattice = hexagonal_lattice(box, 100, 1.0);
  ASSERT_TRUE(lattice.has_value());
  EXPECT_EQ(lattice->columns, 10U);
  EXPECT_EQ(lattice->rows, 10U);
  EXPECT_NEAR(least_distance(box, sites_of(*lattice, 100)), 1.0, 1e-12) << "the closest packing";
  EXPECT_FALSE(hexagonal_lattice(box, 101, 1.0).has_value());
}

TEST(HexagonalLattice, ClosesThroughPeriodicSides) {
  const auto lattice = hexagonal_lattice(box_of(7, 9, Periodic::y), 15, 1.0);
  ASSERT_TRUE(lattice.has_value());
  EXPECT_EQ(lattice->rows % 2, 0U);
  EXPECT_DOUBLE_EQ(lattice->spacing_y * static_cast<double>(lattice->rows), 9.0);
}

// Even rows are as far from the left side as odd rows from the right side, so that no disk is on a side.
TEST(HexagonalLattice, IsInTheMiddleOfAPeriodicWidth) {
  const auto lattice = hexagonal_lattice(box_of(8, 30, Periodic::x), 40, 1.0);
  ASSERT_TRUE(lattice.has_value());
  ASSERT_GT(lattice->columns, 1U);
  const Count last = lattice->columns - 1;
  const Count all = lattice->columns * lattice->rows;
  EXPECT_DOUBLE_EQ(lattice_site(*lattice, 0, all).x, 0.25 * lattice->spacing_x);
  EXPECT_DOUBLE_EQ(lattice_site(*lattice, lattice->columns + last, all).x, 8.0 - 0.25 * lattice->spacing_x);
}

// In a narrow box disks touch the two sides in turn, and the disk of the row below.
TEST(HexagonalLattice, ZigzagsBetweenNarrowSides) {
  const double rise = std::sqrt(1.0 - 0.2 * 0.2);
  const Domain box = box_of(1.2, 1.0 + 4.0 * rise + 1e-9);
  EXPECT_EQ(hexagonal_capacity(box, 1.0), 5U);
  const auto lattice = hexagonal_lattice(box, 5, 1.0);
  ASSERT_TRUE(lattice.has_value());
  for (Count k = 0; k < 5; ++k) {
    const Vec2 site = lattice_site(*lattice, k, 5);
    EXPECT_NEAR(site.x, k % 2 == 0 ? 0.5 : 0.7, 1e-12) << k;
    EXPECT_NEAR(site.y, 0.5 + static_cast<double>(k) * rise, 1e-8) << k;
  }
}

TEST(HexagonalLattice, HoldsMoreThanTheSquareInALargeBox) {
  EXPECT_GT(hexagonal_capacity(box_of(50, 50), 1.0), square_capacity(box_of(50, 50), 1.0));
}

// In any box, up to the capacity computed for it, disks neither overlap each other nor the sides.
TEST(Lattices, SoundInAnyBoxUpToTheirCapacity) {
  Draws draws(21);
  for (int k = 0; k < 400; ++k) {
    const double diameter = draws.decades(1e-3, 1e3);
    const Domain box =
        box_of(diameter * draws.in(2, 12), diameter * draws.in(2, 12), periodic_along(k % 2 == 0, k / 2 % 2 == 0));
    SCOPED_TRACE(k);
    for (const bool square : {true, false}) {
      const Count capacity = square ? square_capacity(box, diameter) : hexagonal_capacity(box, diameter);
      ASSERT_GT(capacity, 0U);
      for (const Count count : {capacity, Count{1}, 1 + draws.bits() % capacity}) {
        const auto lattice = square ? square_lattice(box, count, diameter) : hexagonal_lattice(box, count, diameter);
        ASSERT_TRUE(lattice.has_value()) << count << " of " << capacity << (square ? " square" : " hexagonal");
        expect_sound(box, *lattice, count, diameter);
      }
      const auto over =
          square ? square_lattice(box, capacity + 1, diameter) : hexagonal_lattice(box, capacity + 1, diameter);
      EXPECT_FALSE(over.has_value());
    }
  }
}

TEST(Lattices, CellsAreNearlyRegularWhenThereIsRoom) {
  Draws draws(22);
  for (int k = 0; k < 100; ++k) {
    const Domain box = box_of(draws.in(50, 150), draws.in(50, 150), periodic_along(k % 2 == 0, k / 2 % 2 == 0));
    const Count count = 200 + draws.bits() % 2000;
    const auto square = square_lattice(box, count, 0.1);
    const auto hexagonal = hexagonal_lattice(box, count, 0.1);
    ASSERT_TRUE(square && hexagonal);
    EXPECT_NEAR(square->spacing_y / square->spacing_x, 1.0, 0.1) << k;
    EXPECT_NEAR(hexagonal->spacing_y / hexagonal->spacing_x, 0.866, 0.12) << k;
    EXPECT_LT(square->columns * square->rows, count + count / 8 + 2);
  }
}

TEST(Lattices, HugeCountsAreQuick) {
  const auto lattice = hexagonal_lattice(box_of(1e5, 1e5, Periodic::both), 4'000'000'000, 1.0);
  ASSERT_TRUE(lattice.has_value());
  const Vec2 last = lattice_site(*lattice, 3'999'999'999, 4'000'000'000);
  EXPECT_LT(last.x, 1e5);
  EXPECT_LT(last.y, 1e5);
  EXPECT_GT(last.y, 0.99e5);
}

}  // namespace
}  // namespace carom
