// Pairs by distance: the grid compared with all pairs, several threads with one, and g = 1 without correlations.
#include "core/measure/pair_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/measure/analysis_curves.hpp"
#include "parallel/threads/executor.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

bool far_from_walls(const Disks& d, std::size_t i, const Domain& box, double margin) {
  const bool x = box.periodic_x() || (d.x[i] >= margin && d.x[i] <= box.width - margin);
  const bool y = box.periodic_y() || (d.y[i] >= margin && d.y[i] <= box.height - margin);
  return x && y;
}

// Each centre is compared with every other disk.
PairCounts all_pairs(const Disks& d, const Domain& box, const DistanceBins& bins) {
  PairCounts found{0, std::vector<Count>(bins.bins, 0)};
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!far_from_walls(d, i, box, bins.wall_margin)) continue;
    ++found.centres;
    for (std::size_t j = 0; j < d.size(); ++j) {
      if (j == i) continue;
      const Vec2 apart = nearest_image(Vec2{d.x[j] - d.x[i], d.y[j] - d.y[i]}, box);
      const double r = std::sqrt(apart.x * apart.x + apart.y * apart.y);
      const double bin = r * (static_cast<double>(bins.bins) / bins.r_max);
      if (bin < static_cast<double>(bins.bins)) ++found.counts[static_cast<std::size_t>(bin)];
    }
  }
  return found;
}

struct Case {
  double width, height;
  SideKind left_right, bottom_top;
  double r_max;
};
// Square and thin boxes, some with a single cell along a side; walls and periodic sides.
constexpr SideKind wall = SideKind::wall, around = SideKind::periodic;
const std::vector<Case> cases{{20.0, 20.0, around, around, 3.0}, {20.0, 20.0, wall, wall, 3.0},
                              {50.0, 7.0, around, around, 3.5},  {50.0, 7.0, around, wall, 2.0},
                              {7.0, 50.0, wall, around, 2.5},    {9.0, 10.0, around, around, 3.0},
                              {8.0, 8.0, around, around, 4.0},   {30.0, 20.0, SideKind::sink, around, 2.0}};

TEST(PairDistances, CountsAreThoseOfAllPairsOnAnyNumberOfThreads) {
  test::Draws draws(11);
  for (const Case& c : cases) {
    Domain box{c.width, c.height};
    test::set_sides(box, c.left_right, c.bottom_top);
    for (const std::size_t n : {0U, 1U, 2U, 30U, 700U}) {
      const Disks disks = test::strewn(draws, box, n);
      const DistanceBins bins{c.r_max, 23, c.r_max + 0.1};
      const PairCounts expected = all_pairs(disks, box, bins);
      for (const int threads : {0, 1, 2, 5}) {
        const PairCounts found =
            count_pairs(disks, box, bins, threads == 0 ? BlockRunner(run_in_order) : blocks_on_threads(threads));
        EXPECT_EQ(found.centres, expected.centres);
        EXPECT_EQ(found.counts, expected.counts) << c.width << " x " << c.height << ", " << n << " disks, " << threads;
      }
    }
  }
}

// So few disks that a row has one cell, with disks in the order of storage.
TEST(PairDistances, CountsOfVeryFewDisksAreThoseOfAllPairs) {
  test::Draws draws(15);
  for (const Case& c : cases) {
    Domain box{c.width, c.height};
    test::set_sides(box, c.left_right, c.bottom_top);
    const DistanceBins bins{c.r_max, 7, 0.0};
    for (std::size_t n = 2; n < 7; ++n) {
      for (int k = 0; k < 40; ++k) {
        const Disks disks = test::strewn(draws, box, n);
        EXPECT_EQ(count_pairs(disks, box, bins).counts, all_pairs(disks, box, bins).counts)
            << c.width << " x " << c.height << ", " << n << " disks";
      }
    }
  }
}

TEST(PairDistances, TwoDisksOfOneCellMeetRoundThePeriodicSide) {
  const Domain box = test::box_of(10.0, 10.0, test::Periodic::x);
  for (const double first : {0.3, 9.6}) {
    const Disks disks = test::disks_of({{first, 3.0}, {9.9 - first, 3.0}});
    EXPECT_EQ(count_pairs(disks, box, {2.0, 2, 0.0}).counts, (std::vector<Count>{2, 0}));
  }
}

// Two disks are a little less than r_max apart, one above the other, the upper one by the last bit below the edge of a
// row: a division may round it into the row above.
TEST(PairDistances, NoPairIsLostAtTheEdgeOfARow) {
  test::Draws draws(17);
  int rounded_up = 0;
  for (int k = 0; k < 60; ++k) {
    const Domain box = test::box_of(100.0, draws.in(9.0, 11.0));
    Disks others;  // further away, so that there are rows
    for (DiskId id = 0; id < 160; ++id) {
      append(others, {4.0 + 2.3 * (id % 40), box.height * (id / 40 + 0.5) / 4.0, 0, 0, 0.1, 1.0, id});
    }
    const auto rows = static_cast<double>(DistanceCells(others, box, {2.0, 4, 0.0}).rows());
    ASSERT_GE(rows, 8.0);
    for (double row = 4.0; row < rows; row += 1.0) {
      const double high = std::nextafter(row * (box.height / rows), 0.0), low = high - 2.0;
      rounded_up += std::floor(high / box.height * rows) == row ? 1 : 0;
      Disks disks = others;
      append(disks, {1.0, low, 0, 0, 0.1, 1.0, 160});
      append(disks, {1.0, high, 0, 0, 0.1, 1.0, 161});
      const DistanceBins bins{std::nextafter(high - low, 3.0), 1, 0.0};
      ASSERT_EQ(count_pairs(disks, box, bins).counts, std::vector<Count>{2}) << box.height << ", row " << row;
    }
  }
  EXPECT_GT(rounded_up, 20) << "too few rows were rounded up, so this tests nothing";
}

// The images above are displaced; there are from two rows, which count as one, to ten.
TEST(PairDistances, CountsInAShearedBoxAreThoseOfAllPairs) {
  test::Draws draws(16);
  for (int k = 0; k < 60; ++k) {
    const double r_max = 2.0;
    Domain box = test::box_of(draws.in(2.0, 5.0) * r_max, draws.in(2.0, 5.0) * r_max, test::Periodic::both);
    box.shear = {1.0, box.height, draws.in(-0.5, 0.5) * box.width};
    const Disks disks = test::strewn(draws, box, 100);
    const DistanceBins bins{r_max, 9, 0.0};
    EXPECT_EQ(count_pairs(disks, box, bins).counts, all_pairs(disks, box, bins).counts)
        << box.width << " x " << box.height << ", offset " << box.shear.offset;
  }
}

// Random points: g = 1 in every bin, within four standard errors of the number of pairs.
TEST(PairDistances, NothingCorrelatedGivesOne) {
  test::Draws draws(12);
  for (const Case& c : cases) {
    Scene scene;
    scene.box = {c.width, c.height};
    test::set_sides(scene.box, c.left_right, c.bottom_top);
    scene.analysis.wanted[0] = true;
    scene.analysis.pairs.r_max = c.r_max;
    scene.analysis.pairs.bins = 12;
    scene.analysis.pairs.wall_margin = c.r_max + 0.1;
    AnalysisRecord record = empty_record(scene);
    for (int k = 0; k < 200; ++k) take_sample(record, scene, test::strewn(draws, scene.box, 200), k, {}, run_in_order);
    const BinnedCurve g = pair_correlation_curve(record.pairs, scene.analysis);
    for (std::size_t k = 0; k < 12; ++k) {
      const auto pairs = static_cast<double>(record.pairs.counts[k]);
      ASSERT_GT(pairs, 100.0);
      // A pair of two centres is counted twice.
      const double error = std::sqrt(2.0 / pairs);
      EXPECT_NEAR(g.value[k], 1.0, 4.0 * error) << c.width << " x " << c.height << ", bin " << k;
    }
  }
}

// Random points between moving sides: g = 1 at any time, and no centre is closer to a side than the margin.
TEST(PairDistances, MarginsGoWithSidesThatMove) {
  test::Draws draws(14);
  Scene scene;
  scene.box = {30.0, 20.0};
  test::set_sides(scene.box, wall, around);
  scene.box.motions[0] = {SideMotion::Kind::steady, 2.0, 0.5};
  scene.box.motions[1] = {SideMotion::Kind::steady, 1.0, 1.0};
  scene.analysis.wanted[0] = true;
  scene.analysis.pairs = {2.0, 8, 2.1};
  AnalysisRecord record = empty_record(scene);
  for (int k = 0; k < 200; ++k) {
    const double t = 0.04 * k;
    Disks disks = test::strewn(draws, scene.box, 200);
    const double left = 2.0 + 0.5 * t, right = 29.0 - t;
    for (double& x : disks.x) x = left + x / scene.box.width * (right - left);
    take_sample(record, scene, disks, t, {}, run_in_order);
  }
  const BinnedCurve g = pair_correlation_curve(record.pairs, scene.analysis);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(g.value[k], 1.0, 4.0 * std::sqrt(2.0 / static_cast<double>(record.pairs.counts[k]))) << "bin " << k;
  }
}

// g(r) of three groups: the pairs of each two groups are those found by a search over all disks.
TEST(PairDistances, GroupsHavePairsOfTheirOwn) {
  test::Draws draws(13);
  Scene scene;
  scene.box = {20.0, 16.0};
  test::set_sides(scene.box, around, wall);
  scene.analysis.wanted[0] = true;
  scene.analysis.pairs = {3.0, 10, 3.1};
  scene.analysis.pair_groups = {{"a", {0, 100}}, {"b", {250, 400}}, {"c", {400, 401}}};
  AnalysisRecord record = empty_record(scene);
  const Disks disks = test::strewn(draws, scene.box, 500);
  take_sample(record, scene, disks, 0.0, {}, run_in_order);
  take_sample(record, scene, disks, 1.0, {}, run_in_order);
  const std::vector<PartialCurve> curves = partial_curves(record, scene.analysis);
  ASSERT_EQ(curves.size(), 6U);
  const auto centres = [&](const IdRange& ids) {
    Count n = 0;
    for (std::size_t i = 0; i < disks.size(); ++i)
      n += ids.holds(disks.id[i]) && far_from_walls(disks, i, scene.box, 3.1);
    return n;
  };
  std::size_t next = 0;
  for (const NamedIds& one : scene.analysis.pair_groups) {
    for (const NamedIds& other : scene.analysis.pair_groups) {
      if (other.ids.first < one.ids.first) continue;
      std::vector<Count> expected(10, 0);
      for (std::size_t i = 0; i < disks.size(); ++i) {
        if (!far_from_walls(disks, i, scene.box, 3.1)) continue;
        for (std::size_t j = 0; j < disks.size(); ++j) {
          const bool pair = (one.ids.holds(disks.id[i]) && other.ids.holds(disks.id[j])) ||
                            (other.ids.holds(disks.id[i]) && one.ids.holds(disks.id[j]));
          const double r = std::sqrt(nearest_distance2({disks.x[j] - disks.x[i], disks.y[j] - disks.y[i]}, scene.box));
          if (pair && j != i && r < 3.0) expected[static_cast<std::size_t>(r / 0.3)] += 2;  // two samples
        }
      }
      EXPECT_EQ(curves[next].group + curves[next].other, one.name + other.name);
      EXPECT_EQ(record.partial[next].counts, expected) << one.name << other.name;
      const double n1 = static_cast<double>(centres(one.ids)), n2 = static_cast<double>(centres(other.ids));
      const double ideal = 2.0 * (one.name == other.name ? n1 * (n1 - 1.0) : 2.0 * n1 * n2) / (20.0 * (16.0 - 6.2));
      EXPECT_NEAR(record.partial[next].expected, ideal, 1e-9);
      ++next;
    }
  }
}

// [analysis] select: pairs are those of the group only, even if other disks are near.
TEST(PairDistances, ASelectionHasPairsOfItsDisksAlone) {
  Scene scene;
  scene.box = test::box_of(10.0, 10.0, test::Periodic::both);
  scene.analysis.wanted[0] = true;
  scene.analysis.pairs = {2.0, 2, 0.0};
  scene.analysis.group = "b";
  scene.analysis.ids = {1, 3};
  AnalysisRecord record = empty_record(scene);
  const Disks disks = test::disks_of({{5.0, 5.0}, {5.5, 5.0}, {5.5, 6.5}, {6.0, 6.0}});
  take_sample(record, scene, disks, 0.0, {}, run_in_order);
  EXPECT_EQ(record.pairs.counts, (std::vector<Count>{0, 2})) << "1 and 2, 1.5 apart";
  EXPECT_EQ(record.pairs.centres, 2U);
}

// If the margins of both sides overlap no disk is a centre, and there is no area for centres.
TEST(PairDistances, ABoxWithinItsMarginsHasNoCentres) {
  const Domain box = test::box_of(10.0, 8.0);
  const DistanceBins bins{3.0, 10, 6.0};
  EXPECT_EQ(area_of_centres(box, bins), 0.0);
  EXPECT_EQ(count_pairs(test::disks_of({{5.0, 4.0}, {6.0, 4.0}}), box, bins).centres, 0U);
}

// A square lattice: 4 neighbours at 1, 4 at sqrt 2, 4 at 2, and none at other distances.
TEST(PairDistances, LatticeHasItsShells) {
  Domain box{12.0, 12.0};
  test::set_sides(box, SideKind::periodic, SideKind::periodic);
  Disks disks;
  for (int k = 0; k < 144; ++k) {
    const Vec2 c = test::cell_centre(k, 12, 1.0);
    append(disks, {c.x, c.y, 0.0, 0.0, 0.4, 1.0, static_cast<DiskId>(k)});
  }
  const PairCounts found = count_pairs(disks, box, {2.1, 21, 3.0});
  for (std::size_t k = 0; k < 21; ++k) {
    EXPECT_EQ(found.counts[k], k == 10 || k == 14 || k == 20 ? 4U * 144U : 0U) << k;
  }
}

}  // namespace
}  // namespace carom
