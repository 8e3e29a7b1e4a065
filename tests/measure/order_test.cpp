// Structure factor, bond order, velocity autocorrelation and profiles of motion, compared with known cases.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_memory.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/motion_profile.hpp"
#include "core/measure/structure_factor.hpp"
#include "core/measure/velocity_memory.hpp"
#include "parallel/threads/executor.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

constexpr Stream stream = Stream::position;

// The same disks stored in reverse order.
Disks turned(const Disks& d) {
  Disks other;
  for (std::size_t i = d.size(); i-- > 0;) append(other, disk_at(d, i));
  return other;
}

Disks ideal_gas(std::size_t n, const Domain& box, std::uint64_t seed) {
  Disks d;
  for (DiskId id = 0; id < n; ++id) {
    const TwoUniforms u = uniforms(seed, stream, id, 0);
    const Vec2 v = normals(seed, Stream::velocity, id, 0);
    append(d, {box.width * u.a, box.height * u.b, v.x, v.y, 0.01, 1.0, id});
  }
  return d;
}

// A perfect triangular lattice of spacing 1 with these numbers of columns and rows, and its box.
Disks triangles(int columns, int rows, Domain& box) {
  const double h = std::sqrt(0.75);
  box = test::box_of(columns, rows * h, test::Periodic::both);
  Disks d;
  for (int k = 0; k < columns * rows; ++k) {
    const int row = k / columns;
    append(d, {k % columns + (row % 2 == 1 ? 0.75 : 0.25), h * (row + 0.5), 0, 0, 0.5, 1.0, static_cast<DiskId>(k)});
  }
  return d;
}

// |rho_k|^2 / N of an ideal gas is exponentially distributed with mean 1: the mean over `waves` has the error 1 /
// sqrt(waves).
TEST(StructureFactor, OfAnIdealGasIsOne) {
  const Domain box = test::box_of(30.0, 20.0, test::Periodic::both);
  StructureFactor s{std::vector<double>(100, 0.0), std::vector<double>(100, 0.0), 0};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) add_structure(s, ideal_gas(500, box, seed), box);
  EXPECT_EQ(s.samples, 40U);
  double mean = 0.0;
  for (const std::vector<double>* axis : {&s.along_x, &s.along_y}) {
    for (const double sum : *axis) mean += sum / 40.0 / 200.0;
  }
  EXPECT_NEAR(mean, 1.0, 4.0 / std::sqrt(40.0 * 200.0));
}

// Rows are sqrt(3)/2 apart and columns 1/2: there are Bragg peaks of height N at 2 pi over these distances, and nothing
// in between.
TEST(StructureFactor, OfALatticeHasBraggPeaks) {
  Domain box;
  const Disks d = triangles(12, 14, box);
  StructureFactor s{std::vector<double>(30, 0.0), std::vector<double>(30, 0.0), 0};
  add_structure(s, d, box);
  for (std::size_t n = 1; n <= 30; ++n) {
    EXPECT_NEAR(s.along_x[n - 1], n == 24 ? 168.0 : 0.0, 1e-9) << n;
    EXPECT_NEAR(s.along_y[n - 1], n == 14 || n == 28 ? 168.0 : 0.0, 1e-9) << n;
  }
}

TEST(StructureFactor, ASideThatIsNoPeriodAndNoDisksGiveNothing) {
  const Domain box = test::box_of(30.0, 20.0, test::Periodic::x);
  StructureFactor s{std::vector<double>(5, 0.0), {}, 0};
  add_structure(s, Disks{}, box);
  EXPECT_EQ(s.samples, 0U);
  add_structure(s, ideal_gas(10, box, 1), box);
  EXPECT_TRUE(s.along_y.empty());
}

TEST(BondOrder, OfAHexagonalLatticeIsOne) {
  for (const auto& [columns, rows] : {std::pair(12, 14), std::pair(3, 4), std::pair(40, 6)}) {
    Domain box;
    const Disks d = triangles(columns, rows, box);
    const BondOrder order = bond_order(d, box);
    EXPECT_NEAR(order.local, 1.0, 1e-12) << columns;
    EXPECT_NEAR(order.global, 1.0, 1e-12) << columns;
  }
}

// Two crystals, one rotated by 30 degrees: there is order around each disk, but none in common.
TEST(BondOrder, TurnedCrystalsHaveNoOrderInCommon) {
  const double h = std::sqrt(0.75);
  Disks d;
  DiskId id = 0;
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < 900; ++k) {
      const int row = k / 30;
      const double a = k % 30 + (row % 2 == 1 ? 0.5 : 0.0) - 15.0, b = h * row - 15.0 * h;
      const double c = side == 0 ? 1.0 : std::sqrt(0.75), s = side == 0 ? 0.0 : 0.5;
      append(d, {50.0 + 100.0 * side + c * a - s * b, 50.0 + s * a + c * b, 0, 0, 0.4, 1.0, id++});
    }
  }
  const BondOrder order = bond_order(d, test::box_of(200.0, 100.0));
  EXPECT_GT(order.local, 0.9) << "all disks except those at the edges";
  EXPECT_LT(order.global, 0.05);
}

BondPairs pairs_of(const Disks& d, const Domain& box, const DistanceBins& bins) {
  return bond_pairs(with_orders(d, bond_orders(d, box)), box, bins);
}

// On a hexagonal lattice all psi6 are equal, so g6 is 1 wherever there are pairs, that is at distances of the lattice.
TEST(BondCorrelation, OfAHexagonalLatticeIsOne) {
  Domain box;
  const Disks d = triangles(12, 14, box);
  const DistanceBins bins{5.0, 50, 0.0};
  BondCorrelation sums{std::vector<double>(50, 0.0), std::vector<Count>(50, 0), 0};
  add_bond_pairs(sums, pairs_of(d, box, bins));
  EXPECT_EQ(sums.samples, 1U);
  EXPECT_EQ(sums.pairs[10] + sums.pairs[9], 168U * 6U)
      << "pairs at the lattice spacing, which rounding may put into either bin";
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_NEAR(sums.product[k], static_cast<double>(sums.pairs[k]), 1e-9) << k;
  }
}

// Compared with all pairs, with walls, whose neighbourhood is left out; and for any order of storage.
TEST(BondCorrelation, OfAGasIsThatOfAllPairs) {
  const Domain box = test::box_of(30.0, 20.0, test::Periodic::x);
  const Disks d = ideal_gas(300, box, 3);
  const std::vector<Vec2> psi = bond_orders(d, box);
  constexpr std::size_t n = 12;
  const DistanceBins bins{6.0, n, 6.1};
  std::vector<double> product(n, 0.0);
  std::vector<Count> pairs(n, 0);
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d.y[i] < 6.1 || d.y[i] > 20.0 - 6.1) continue;
    for (std::size_t j = 0; j < d.size(); ++j) {
      const double r = std::sqrt(nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box));
      if (j == i || r >= 6.0) continue;
      product[static_cast<std::size_t>(2.0 * r)] += psi[i].x * psi[j].x + psi[i].y * psi[j].y;
      ++pairs[static_cast<std::size_t>(2.0 * r)];
    }
  }
  BondCorrelation sums{std::vector<double>(n, 0.0), std::vector<Count>(n, 0), 0}, other = sums;
  add_bond_pairs(sums, pairs_of(d, box, bins));
  add_bond_pairs(other, pairs_of(turned(d), box, bins));
  EXPECT_EQ(sums.pairs, pairs);
  EXPECT_EQ(sums.product, other.product) << "the order of storage must not matter";
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(sums.product[k], product[k], 1e-9) << k;
}

// There are enough disks for several blocks.
TEST(BondCorrelation, HasTheSameBitsOnAnyThreads) {
  const Domain box = test::box_of(130.0, 90.0, test::Periodic::x);
  const Disks d = ideal_gas(10'000, box, 5);
  const DistanceBins bins{2.0, 20, 2.1};
  const std::vector<Vec2> psi = bond_orders(d, box);
  const BondPairs pairs = bond_pairs(with_orders(d, psi), box, bins);
  for (const int threads : {1, 2, 3, 8}) {
    SCOPED_TRACE(threads);
    const BlockRunner run = blocks_on_threads(threads);
    const std::vector<Vec2> shared = bond_orders(d, box, run);
    ASSERT_EQ(shared.size(), psi.size());
    for (std::size_t i = 0; i < psi.size(); ++i) EXPECT_TRUE(shared[i].x == psi[i].x && shared[i].y == psi[i].y) << i;
    EXPECT_FALSE(bond_orders_of_first(d, d.size(), box, 0.5, run)) << "sixth neighbours are further away";
    const BondPairs found = bond_pairs(with_orders(d, shared), box, bins, run);
    EXPECT_EQ(found.counts, pairs.counts);
    for (std::size_t k = 0; k < bins.bins; ++k) EXPECT_EQ(value_of(found.product[k]), value_of(pairs.product[k])) << k;
  }
}

// A crystal keeps its directions however it moves.
TEST(BondMemory, OfACrystalIsOne) {
  Domain box;
  Disks d = triangles(12, 14, box);
  BondMemory memory;
  begin_memory(memory, d, box);
  EXPECT_NEAR(bond_autocorrelation(memory, d, box), 1.0, 1e-12);
  for (std::size_t i = 0; i < d.size(); ++i) {
    d.x[i] = wrap(d.x[i] + 3.3, box.width);
    d.y[i] = wrap(d.y[i] + 1.7, box.height);
  }
  EXPECT_NEAR(bond_autocorrelation(memory, d, box), 1.0, 1e-12);
}

// A rotation by a multiplies each psi6 by exp(6 i a).
TEST(BondMemory, FallsByTheAngleOfATurn) {
  const Domain box = test::box_of(100.0, 100.0);
  const Disks start = ideal_gas(300, test::box_of(40.0, 40.0), 9);
  for (const double a : {0.0, 0.1, std::numbers::pi / 12.0, 0.5, std::numbers::pi / 3.0}) {
    Disks before = start, after = start;
    for (std::size_t i = 0; i < start.size(); ++i) {
      const double x = start.x[i] - 20.0, y = start.y[i] - 20.0;
      before.x[i] = 50.0 + x;
      before.y[i] = 50.0 + y;
      after.x[i] = 50.0 + std::cos(a) * x - std::sin(a) * y;
      after.y[i] = 50.0 + std::sin(a) * x + std::cos(a) * y;
    }
    BondMemory memory;
    begin_memory(memory, before, box);
    EXPECT_NEAR(bond_autocorrelation(memory, after, box), std::cos(6.0 * a), 1e-10) << a;
    EXPECT_EQ(bond_autocorrelation(memory, turned(after), box), bond_autocorrelation(memory, after, box));
  }
}

// In an ideal gas neighbours separate: the correlation is near 1 while disks have hardly moved, and vanishes when they
// have new neighbours. The sum of N products of independent psi6 scatters by sqrt(N / 2) <|psi6|^2>; neighbours share a
// part of it.
TEST(BondMemory, OfAnIdealGasIsForgotten) {
  constexpr std::size_t n = 20'000;
  const Domain box = test::box_of(200.0, 100.0, test::Periodic::both);
  const Disks start = ideal_gas(n, box, 11);
  BondMemory memory;
  begin_memory(memory, start, box);
  double last = 1.0;
  for (const double t : {0.001, 0.03, 0.1, 0.3, 100.0}) {
    Disks d = start;
    for (std::size_t i = 0; i < n; ++i) {
      d.x[i] -= box.width * std::floor((d.x[i] + t * d.vx[i]) / box.width) - t * d.vx[i];
      d.y[i] -= box.height * std::floor((d.y[i] + t * d.vy[i]) / box.height) - t * d.vy[i];
      d.x[i] = wrap(d.x[i], box.width);
      d.y[i] = wrap(d.y[i], box.height);
    }
    const double now = bond_autocorrelation(memory, d, box);
    EXPECT_LT(now, last) << t;
    if (t == 0.001) {
      EXPECT_GT(now, 0.98);
    }
    last = now;
  }
  EXPECT_NEAR(last, 0.0, 6.0 / std::sqrt(2.0 * n));
}

// By hand: disks that are gone are left out of both states, and a disk that came later is not included.
TEST(BondMemory, IsOfTheDisksThatAreStillThere) {
  const Domain box = test::box_of(30.0, 20.0);
  Disks first = ideal_gas(40, box, 5), later;
  BondMemory memory;
  begin_memory(memory, first, box);
  for (std::size_t i = 10; i < 40; ++i) append(later, disk_at(ideal_gas(40, box, 6), i));
  append(later, {15.0, 10.0, 0, 0, 0.01, 1.0, 77});
  const std::vector<Vec2> then = bond_orders(first, box), now = bond_orders(later, box);
  double product = 0.0, square = 0.0;
  for (std::size_t k = 0; k < 30; ++k) {
    product += then[k + 10].x * now[k].x + then[k + 10].y * now[k].y;
    square += then[k + 10].x * then[k + 10].x + then[k + 10].y * then[k + 10].y;
  }
  EXPECT_NEAR(bond_autocorrelation(memory, later, box), product / square, 1e-12);
  EXPECT_TRUE(std::isnan(bond_autocorrelation(memory, Disks{}, box)));
  EXPECT_TRUE(std::isnan(bond_autocorrelation(memory, ideal_gas(6, box, 1), box)));
  BondMemory nothing;
  begin_memory(nothing, ideal_gas(6, box, 1), box);
  EXPECT_TRUE(std::isnan(bond_autocorrelation(nothing, later, box)));
}

// Compared with all pairs. Six independent angles would have a mean |psi6| of sqrt(pi) / 2 / sqrt(6) = 0.36, a gas has
// a little more, and disks in a row have 1. The search must end, too, in boxes with 3e5 columns and one row.
TEST(BondOrder, OfAGasIsThatOfAllPairs) {
  for (const Domain& box :
       {test::box_of(30.0, 20.0), test::box_of(30.0, 20.0, test::Periodic::x),
        test::box_of(1e9, 2.0, test::Periodic::x), test::box_of(2.0, 1e9, test::Periodic::y), test::box_of(1e9, 2.0)}) {
    const Disks d = ideal_gas(400, box, 7);
    double local = 0.0, x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      std::vector<std::pair<double, double>> all;  // distance, angle
      for (std::size_t j = 0; j < d.size(); ++j) {
        const Vec2 apart = nearest_image(Vec2{d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
        if (j != i) all.emplace_back(std::hypot(apart.x, apart.y), std::atan2(apart.y, apart.x));
      }
      std::sort(all.begin(), all.end());
      Vec2 psi;
      for (std::size_t k = 0; k < 6; ++k) {
        psi.x += std::cos(6.0 * all[k].second) / 6.0;
        psi.y += std::sin(6.0 * all[k].second) / 6.0;
      }
      local += std::hypot(psi.x, psi.y) / 400.0;
      x += psi.x / 400.0;
      y += psi.y / 400.0;
    }
    const BondOrder order = bond_order(d, box);
    EXPECT_NEAR(order.local, local, 1e-10);
    EXPECT_NEAR(order.global, std::hypot(x, y), 1e-10);
    EXPECT_EQ(bond_order(turned(d), box).local, order.local) << "the order of storage must not matter";
    const bool line = box.width * box.height > 1e9;
    EXPECT_GT(order.local, line ? 0.999 : 0.3);
    EXPECT_LT(order.local, line ? 1.001 : 0.5);
  }
}

TEST(BondOrder, NeedsSevenDisks) {
  const Domain box = test::box_of(30.0, 20.0);
  EXPECT_TRUE(std::isnan(bond_order(ideal_gas(6, box, 7), box).local));
  EXPECT_FALSE(std::isnan(bond_order(ideal_gas(7, box, 7), box).local));
  EXPECT_TRUE(std::isnan(bond_order(Disks{}, box).global));
}

TEST(VelocityMemory, FreeFlightForgetsNothingAndAWallTurnsItRound) {
  const Domain box = test::box_of(30.0, 20.0);
  Disks d = ideal_gas(100, box, 3);
  VelocityMemory memory;
  begin_memory(memory, d);
  double mean = 0.0;
  for (std::size_t i = 0; i < 100; ++i) mean += (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]) / 100.0;
  EXPECT_NEAR(velocity_autocorrelation(memory, d), mean, 1e-12);
  EXPECT_EQ(velocity_autocorrelation(memory, turned(d)), velocity_autocorrelation(memory, d));
  append(d, {1, 1, 1e6, 1e6, 0.1, 1.0, 100});
  EXPECT_NEAR(velocity_autocorrelation(memory, d), mean, 1e-12) << "a disk that came later is not included";
  for (std::size_t i = 0; i < 100; ++i) {
    d.vx[i] = -d.vx[i];
    d.vy[i] = -d.vy[i];
  }
  EXPECT_NEAR(velocity_autocorrelation(memory, d), -mean, 1e-12);
  EXPECT_TRUE(std::isnan(velocity_autocorrelation(memory, Disks{})));
}

// A shear flow vx = 0.2 y at temperature 1, with masses of 1 and 4: the temperature excludes the flow, except for its
// variation within a slab.
TEST(MotionProfile, TellsFlowAndTemperatureApart) {
  const Domain box = test::box_of(30.0, 20.0);
  MotionProfile profile = empty_profile(10);
  Disks d = ideal_gas(40'000, box, 5);
  d.mass.assign(d.size(), 1.0);
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (i % 2 == 0) {
      d.mass[i] = 4.0;
      d.vx[i] *= 0.5;
      d.vy[i] *= 0.5;
    }
    d.vx[i] += 0.2 * d.y[i];
  }
  add_motion(profile, d, box, false);
  for (std::size_t k = 0; k < 10; ++k) {
    const SlabMotion motion = motion_of_slab(profile, k);
    const double n = static_cast<double>(profile.disks[k]);
    const double within = 0.04 * 4.0 / 12.0 * 2.5 / 2.0;  // mean mass times the variance of 0.2 y within a slab, halved
    EXPECT_NEAR(motion.velocity.x, 0.2 * (2.0 * static_cast<double>(k) + 1.0), 5.0 / std::sqrt(n));
    EXPECT_NEAR(motion.velocity.y, 0.0, 5.0 / std::sqrt(n));
    EXPECT_NEAR(motion.temperature, 1.0 + within, 5.0 / std::sqrt(n));
  }
  MotionProfile other = empty_profile(10);
  add_motion(other, turned(d), box, false);
  EXPECT_EQ(other.px, profile.px);
  EXPECT_EQ(other.twice_thermal, profile.twice_thermal);
  EXPECT_TRUE(std::isnan(motion_of_slab(empty_profile(1), 0).temperature));
}

// The velocity is 1 in one sample and 3 in the next: both differ from their mean by 1, which for mass 2 is an energy of
// 1.
TEST(MotionProfile, SamplesOfDifferentVelocityAreHotTogether) {
  MotionProfile profile = empty_profile(1);
  const Domain box = test::box_of(4.0, 4.0);
  for (const double v : {1.0, 3.0}) add_motion(profile, test::disks_of({{2, 2, v, -v, 0.5, 2.0}}), box, false);
  const SlabMotion motion = motion_of_slab(profile, 0);
  EXPECT_DOUBLE_EQ(motion.velocity.x, 2.0);
  EXPECT_DOUBLE_EQ(motion.velocity.y, -2.0);
  EXPECT_DOUBLE_EQ(motion.temperature, 2.0) << "divided by two components";
}

// Cold disks in a fast flow, whose energy leaves no digits for theirs: the temperature is still that of the disks, also
// over many samples, and 0 if all move alike.
TEST(MotionProfile, AColdFlowHasItsTemperature) {
  test::Draws draws(8);
  const Domain box = test::box_of(10.0, 10.0, test::Periodic::both);
  for (const double thermal : {0.0, 1e-6}) {
    for (const double flow : {0.0, 100.0}) {
      MotionProfile profile = empty_profile(1);
      double sum = 0.0;
      for (int sample = 0; sample < 50; ++sample) {
        Disks d;
        for (DiskId id = 0; id < 400; ++id) {
          const double u = draws.in(-thermal, thermal);
          append(d, {draws.in(0.0, 10.0), draws.in(0.0, 10.0), flow + u, 0.5 * flow - u, 0.1, 3.0, id});
          sum += 3.0 * u * u;
        }
        add_motion(profile, d, box, false);
      }
      const SlabMotion motion = motion_of_slab(profile, 0);
      EXPECT_NEAR(motion.velocity.x, flow, 1e-12 * flow + 1e-7);
      EXPECT_GE(motion.temperature, 0.0);
      EXPECT_NEAR(motion.temperature, sum / (50.0 * 400.0), 0.005 * thermal * thermal) << thermal << " " << flow;
    }
  }
}

}  // namespace
}  // namespace carom
