// psi6 in cases where few cells are left to search, and where distances are equal.
#include "core/measure/bond_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

// From the six nearest of all other disks, each by its nearest image; among equally distant ones the lowest ids count.
std::complex<double> order_among_all(const Disks& d, std::size_t i, const Domain& box) {
  std::vector<std::tuple<double, DiskId, double>> all;  // distance^2, id, angle
  for (std::size_t j = 0; j < d.size(); ++j) {
    if (j == i) continue;
    const Vec2 apart = nearest_image(Vec2{d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
    all.emplace_back(apart.x * apart.x + apart.y * apart.y, d.id[j], std::atan2(apart.y, apart.x));
  }
  std::sort(all.begin(), all.end());
  std::complex<double> psi = 0.0;
  for (std::size_t k = 0; k < 6; ++k) psi += std::polar(1.0 / 6.0, 6.0 * std::get<2>(all[k]));
  return psi;
}

// Boxes with one or a few cells along each side, with walls and periodic. An axis all of whose cells have been searched
// must not limit the search; one with a cell left must.
TEST(BondOrder, InBoxesOfFewCellsIsThatOfAllPairs) {
  test::Draws draws(31);
  for (int k = 0; k < 4000; ++k) {
    const Domain box = test::box_of(1.0, draws.in(1.0, 7.0), test::periodic_along(k % 2 == 0, k % 4 < 2));
    const Domain turned = test::box_of(box.height, 1.0, test::periodic_along(k % 4 < 2, k % 2 == 0));
    Disks d, of_turned;
    const auto n = static_cast<DiskId>(draws.in(7.0, 30.0));
    for (DiskId id = 0; id < n; ++id) {
      const double x = draws.in(0.0, 1.0), y = draws.in(0.0, box.height);
      append(d, {x, y, 0, 0, 0.01, 1.0, id});
      append(of_turned, {y, x, 0, 0, 0.01, 1.0, id});
    }
    const std::vector<Vec2> psi = bond_orders(d, box), psi_turned = bond_orders(of_turned, turned);
    for (std::size_t i = 0; i < n; ++i) {
      const std::complex<double> expected = order_among_all(d, i, box);
      ASSERT_NEAR(psi[i].x, expected.real(), 1e-9) << "1 x " << box.height << ", " << n << " disks, case " << k;
      ASSERT_NEAR(psi[i].y, expected.imag(), 1e-9);
      // Reflection in the diagonal makes each angle pi / 2 minus what it was: psi6 becomes the complex conjugate times
      // exp(3 pi i).
      ASSERT_NEAR(psi_turned[i].x, -expected.real(), 1e-9) << box.height << " x 1, " << n << " disks, case " << k;
      ASSERT_NEAR(psi_turned[i].y, expected.imag(), 1e-9);
    }
  }
}

// Boxes that are nearly empty, with dense clusters far apart, across periodic sides or not.
TEST(BondOrder, OfClustersFarApartIsThatOfAllPairs) {
  test::Draws draws(32);
  for (int k = 0; k < 40; ++k) {
    const Domain box = test::box_of(1e4, 2e4, test::periodic_along(k % 2 == 0, k % 4 < 2));
    Disks d;
    for (DiskId id = 0; id < 300; ++id) {
      const double spread = id < 290 ? 1.0 : 1e4;
      append(d, {spread * draws.in(0.0, 1.0), (id % 3 == 0 ? 1.9e4 : 0.0) + 0.1 * spread * draws.in(0.0, 1.0), 0, 0,
                 0.01, 1.0, id});
    }
    const std::vector<Vec2> psi = bond_orders(d, box);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const std::complex<double> expected = order_among_all(d, i, box);
      ASSERT_NEAR(psi[i].x, expected.real(), 1e-9) << "disk " << i << ", case " << k;
      ASSERT_NEAR(psi[i].y, expected.imag(), 1e-9) << "disk " << i << ", case " << k;
    }
  }
}

// With exactly seven disks each has all the others as neighbours; with six psi6 is unknown.
TEST(BondOrder, OfTheFirstDisksIsUnknownWithoutSixOthers) {
  const Domain box = test::box_of(8.0, 8.0, test::Periodic::both);
  Disks d;
  for (DiskId id = 0; id < 6; ++id) append(d, {1.0 + id, 4.0, 0, 0, 0.1, 1.0, id});
  EXPECT_FALSE(bond_orders_of_first(d, 2, box, 10.0));
  EXPECT_TRUE(bond_orders_of_first(d, 0, box, 10.0)->empty()) << "for no disks all are known";
  append(d, {7.5, 4.0, 0, 0, 0.1, 1.0, 6});
  EXPECT_EQ(bond_orders_of_first(d, 2, box, 10.0)->size(), 2U);
}

// On a square lattice, whose distances are integers, four of the next neighbours are equally distant and two of them
// count.
TEST(BondOrder, OfEquallyFarDisksTheLowestIdsCount) {
  constexpr int side = 12;
  const Domain box = test::box_of(side, side, test::Periodic::both);
  std::vector<DiskId> ids(side * side);
  std::iota(ids.begin(), ids.end(), DiskId{0});
  std::mt19937 random(5);
  for (int times = 0; times < 3; ++times) {
    std::shuffle(ids.begin(), ids.end(), random);
    Disks d;
    for (int k = 0; k < side * side; ++k) {
      const Vec2 c = test::cell_centre(k, side, 1.0);
      append(d, {c.x, c.y, 0, 0, 0.4, 1.0, ids[static_cast<std::size_t>(k)]});
    }
    const std::vector<Vec2> psi = bond_orders(d, box);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const std::complex<double> expected = order_among_all(d, i, box);
      EXPECT_NEAR(psi[i].x, expected.real(), 1e-12) << i;
      EXPECT_NEAR(psi[i].y, expected.imag(), 1e-12) << i;
    }
  }
}

// At time 0 images are straight above each other, as without shear. In a flat box many thousand rows of them are closer
// than the sixth neighbour. The nearest image of a disk must be searched for once, not in each row.
TEST(BondOrder, InAFlatShearedBoxIsFoundAtOnce) {
  const Domain plain = test::box_of(1e5, 1.0, test::periodic_along(true, true));
  Domain sheared = plain;
  sheared.shear.rate = sheared.shear.jump = 1.0;
  test::Draws draws(7);
  Disks d;
  for (DiskId id = 0; id < 25; ++id) append(d, {draws.in(0.0, 1e5), draws.in(0.0, 1.0), 0, 0, 0.1, 1.0, id});
  const std::vector<Vec2> psi = bond_orders(d, sheared), expected = bond_orders(d, plain);
  for (std::size_t i = 0; i < d.size(); ++i) {
    EXPECT_NEAR(psi[i].x, expected[i].x, 1e-12) << i;
    EXPECT_NEAR(psi[i].y, expected[i].y, 1e-12) << i;
  }
}

// Without shear images of a row are closer than the sixth neighbour up to 10^11 rows away: they repeat the rows next to
// the box, and must not be searched.
TEST(BondOrder, InALongBoxIsFoundAtOnce) {
  for (const bool tall : {false, true}) {
    const Domain box = test::box_of(tall ? 1.0 : 1e12, tall ? 1e12 : 1.0, test::periodic_along(true, true));
    test::Draws draws(8);
    Disks d;
    for (DiskId id = 0; id < 8; ++id) {
      append(d, {draws.in(0.0, box.width), draws.in(0.0, box.height), 0, 0, 0.1, 1.0, id});
    }
    const std::vector<Vec2> psi = bond_orders(d, box);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const std::complex<double> expected = order_among_all(d, i, box);
      EXPECT_NEAR(psi[i].x, expected.real(), 1e-9) << i;
      EXPECT_NEAR(psi[i].y, expected.imag(), 1e-9) << i;
    }
  }
}

// Disks at one place have no direction from each other.
TEST(BondOrder, DisksAtOnePlaceAddNothing) {
  const Domain box = test::box_of(8.0, 8.0);
  Disks d;
  for (DiskId id = 0; id < 7; ++id) append(d, {4.0, 4.0, 0, 0, 0.1, 1.0, id});
  append(d, {6.0, 4.0, 0, 0, 0.1, 1.0, 7});
  const std::vector<Vec2> psi = bond_orders(d, box);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(psi[i].x == 0.0 && psi[i].y == 0.0) << i;
  EXPECT_NEAR(psi[7].x, 1.0, 1e-12) << "six in one direction";
}

}  // namespace
}  // namespace carom
