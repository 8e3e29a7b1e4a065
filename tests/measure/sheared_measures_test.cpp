// Measurements in a sheared box, compared with all images of all disks, and independent of the choice of images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/measure/analysis.hpp"
#include "core/measure/bond_correlation.hpp"
#include "core/measure/bond_order.hpp"
#include "core/measure/displacement.hpp"
#include "core/measure/follow_disks.hpp"
#include "core/measure/pair_distances.hpp"
#include "core/measure/shear_flow.hpp"
#include "core/measure/structure_factor.hpp"
#include "parallel/threads/executor.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

Domain sheared_box(double width, double height, double offset) {
  Domain box = test::box_of(width, height, test::Periodic::both);
  box.shear = {0.1, 0.1 * height, offset};
  return box;
}

// Calls look(dx, dy) for the images of disk j relative to disk i, in rows that are near, with the nearest image along x
// in each.
template <class Look>
void for_each_image(const Disks& d, std::size_t i, std::size_t j, const Domain& box, const Look& look) {
  for (int k = -9; k <= 9; ++k) {
    const double dx = d.x[j] - d.x[i] + k * box.shear.offset;
    look(dx - box.width * std::round(dx / box.width), d.y[j] - d.y[i] + k * box.height);
  }
}

struct Shape {
  double width, height, r_max;
};
// Many cells, few cells, one cell along a side; the largest r_max, and cells no larger than that.
const Shape shapes[] = {{20, 20, 3}, {50, 7, 3.5}, {7, 50, 2.5}, {9, 10, 3}, {8, 8, 4}, {40, 30, 1}, {12, 12, 3}};
const double offset_shares[] = {0.0, 0.1, -0.25, 0.3333, 0.5, -0.5, 0.4999};  // offsets as shares of the width

TEST(ShearedMeasures, PairDistancesAreThoseOfAllImages) {
  test::Draws draws(21);
  for (const Shape& s : shapes) {
    for (const double share : offset_shares) {
      const Domain box = sheared_box(s.width, s.height, share * s.width);
      const Disks d = test::strewn(draws, box, 200);
      const DistanceBins bins{s.r_max, 23, 0.0};
      std::vector<Count> expected(bins.bins, 0);
      for (std::size_t i = 0; i < d.size(); ++i) {
        for (std::size_t j = 0; j < d.size(); ++j) {
          for_each_image(d, i, j, box, [&](double dx, double dy) {
            const double bin = std::sqrt(dx * dx + dy * dy) * (23.0 / s.r_max);
            if (i != j && bin < 23.0) ++expected[static_cast<std::size_t>(bin)];
          });
        }
      }
      EXPECT_EQ(count_pairs(d, box, bins).counts, expected) << s.width << " x " << s.height << ", " << share;
      EXPECT_EQ(count_pairs(d, box, bins, blocks_on_threads(3)).counts, expected);
      EXPECT_EQ(bond_pairs(with_orders(d, bond_orders(d, box)), box, bins).counts, expected);
    }
  }
}

// Each disk counts once, by its nearest image; with few disks neighbours are further away than half the height.
TEST(LongShearedMeasures, BondOrderIsThatOfAllImages) {
  test::Draws draws(22);
  for (const Shape& s : shapes) {
    for (const double share : offset_shares) {
      for (const std::size_t n : {7U, 12U, 40U, 300U}) {
        const Domain box = sheared_box(s.width, s.height, share * s.width);
        const Disks d = test::strewn(draws, box, n);
        const std::vector<Vec2> orders = bond_orders(d, box);
        ASSERT_EQ(orders.size(), n);
        for (std::size_t i = 0; i < n; ++i) {
          std::vector<std::pair<double, std::complex<double>>> all;
          for (std::size_t j = 0; j < n; ++j) {
            if (j == i) continue;
            Vec2 nearest{1e9, 0.0};
            for_each_image(d, i, j, box, [&](double dx, double dy) {
              if (dx * dx + dy * dy < nearest.x * nearest.x + nearest.y * nearest.y) nearest = {dx, dy};
            });
            const std::complex<double> apart(nearest.x, nearest.y);
            all.emplace_back(std::abs(apart), std::polar(1.0, 6.0 * std::arg(apart)));
          }
          std::partial_sort(all.begin(), all.begin() + 6, all.end(),
                            [](const auto& a, const auto& b) { return a.first < b.first; });
          std::complex<double> psi = 0.0;
          for (int k = 0; k < 6; ++k) psi += all[static_cast<std::size_t>(k)].second / 6.0;
          EXPECT_NEAR(orders[i].x, psi.real(), 1e-9) << s.width << " x " << s.height << ", " << share << ", " << n;
          EXPECT_NEAR(orders[i].y, psi.imag(), 1e-9);
        }
      }
    }
  }
}

// Along x it is the wave of the images with the least |ky|; it does not matter which image of a disk is in the box.
TEST(ShearedMeasures, StructureFactorGoesByWavesThatImagesRepeat) {
  test::Draws draws(23);
  constexpr std::size_t waves = 40;
  for (const double share : offset_shares) {
    const Domain box = sheared_box(30.0, 20.0, share * 30.0);
    const Disks d = test::strewn(draws, box, 60);
    StructureFactor s{std::vector<double>(waves, 0.0), std::vector<double>(waves, 0.0), 0}, other = s;
    add_structure(s, d, box);
    for (std::size_t n = 1; n <= waves; ++n) {
      const double turns = static_cast<double>(n) * share;
      const double kx = 2.0 * std::numbers::pi * static_cast<double>(n) / 30.0;
      const double ky = 2.0 * std::numbers::pi * (std::floor(turns + 0.5) - turns) / 20.0;
      EXPECT_LE(std::abs(ky), std::numbers::pi / 20.0 * (1.0 + 1e-12));
      std::complex<double> sum = 0.0, up = 0.0;
      for (std::size_t i = 0; i < d.size(); ++i) {
        // An arbitrary image.
        const double k = draws.in(-3.0, 3.0) > 0.0 ? 1.0 : -2.0;
        const double x = d.x[i] + k * box.shear.offset - k * 30.0, y = d.y[i] + k * 20.0;
        sum += std::polar(1.0, kx * x + ky * y);
        up += std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(n) * y / 20.0);
      }
      EXPECT_NEAR(s.along_x[n - 1], std::norm(sum) / 60.0, 1e-9) << share << ", " << n;
      EXPECT_NEAR(s.along_y[n - 1], std::norm(up) / 60.0, 1e-9) << share << ", " << n;
    }
    Domain still = box;
    still.shear = {};
    add_structure(other, d, still);
    if (share == 0.0) {
      for (std::size_t n = 0; n < waves; ++n) EXPECT_NEAR(s.along_x[n], other.along_x[n], 1e-9);
    }
  }
}

// A square lattice carried along by the shear.
TEST(ShearedMeasures, StructureFactorOfASlidLatticeHasItsPeak) {
  const double offset = 3.0;
  const Domain box = sheared_box(12.0, 12.0, offset);
  Disks d;
  for (int k = 0; k < 144; ++k) {
    const double y = k / 12 + 0.5;
    append(d, {wrap(k % 12 + 0.5 + offset * y / 12.0, 12.0), y, 0, 0, 0.1, 1.0, static_cast<DiskId>(k)});
  }
  StructureFactor s{std::vector<double>(48, 0.0), std::vector<double>(24, 0.0), 0};
  add_structure(s, d, box);
  // ky = 0 at multiples of 4 waves. Rows are shifted by a quarter of a column along x, so they are in phase at each
  // fourth multiple of 12 waves.
  for (std::size_t n = 1; n <= 48; ++n) EXPECT_NEAR(s.along_x[n - 1], n == 48 ? 144.0 : 0.0, 1e-9) << n;
  for (std::size_t n = 1; n <= 24; ++n) EXPECT_NEAR(s.along_y[n - 1], n % 12 == 0 ? 144.0 : 0.0, 1e-9) << n;
}

// Of two disks one moves with the flow, whose velocity is -0.25 there.
TEST(ShearedMeasures, PressureOfASampleIsOfVelocitiesRelativeToTheFlow) {
  Scene scene;
  scene.box = sheared_box(20.0, 10.0, 0.0);
  scene.analysis.wanted[static_cast<std::size_t>(Quantity::pressure)] = true;
  const Disks disks = test::disks_of({{5.0, 2.5, -0.25, 0.0, 0.1, 1.0}, {15.0, 2.5, 2.75, 4.0, 0.1, 1.0}});
  AnalysisRecord record = empty_record(scene);
  State now;
  take_sample(record, scene, disks, 0.0, now, run_in_order);
  now.time = 2.0;
  now.counters.virial = 14.0;
  take_sample(record, scene, disks, 2.0, now, run_in_order);
  ASSERT_EQ(record.series.pressure.size(), 2U);
  EXPECT_DOUBLE_EQ(record.series.pressure[1], (12.5 + 14.0 / 4.0) / 200.0);
}

// The same two disks: relative to the flow their energies are 0 and 12.5, and T is half of the sum, so their speeds are
// 0 and 2 in units of sqrt(T / m).
TEST(ShearedMeasures, TemperatureAndSpeedsAreRelativeToTheFlow) {
  Scene scene;
  scene.box = sheared_box(20.0, 10.0, 0.0);
  scene.analysis.wanted[static_cast<std::size_t>(Quantity::speeds)] = true;
  scene.analysis.speed_max = 6.0;
  scene.analysis.speed_bins = 4;
  const Disks disks = test::disks_of({{5.0, 2.5, -0.25, 0.0, 0.1, 1.0}, {15.0, 2.5, 2.75, 4.0, 0.1, 1.0}});
  AnalysisRecord record = empty_record(scene);
  take_sample(record, scene, disks, 0.0, {}, run_in_order);
  EXPECT_EQ(record.series.temperature, std::vector<double>{6.25});
  EXPECT_EQ(record.speeds.counts, (std::vector<Count>{1, 1, 0, 0}));
  EXPECT_DOUBLE_EQ(record.speeds.largest_seen, 2.0);
}

// The same two disks: 0 and 3^2 + 4^2.
TEST(ShearedMeasures, VelocitiesAreRememberedRelativeToTheFlow) {
  Scene scene;
  scene.box = sheared_box(20.0, 10.0, 0.0);
  scene.analysis.wanted[static_cast<std::size_t>(Quantity::velocity_autocorrelation)] = true;
  const Disks disks = test::disks_of({{5.0, 2.5, -0.25, 0.0, 0.1, 1.0}, {15.0, 2.5, 2.75, 4.0, 0.1, 1.0}});
  AnalysisRecord record = empty_record(scene);
  take_sample(record, scene, disks, 0.0, {}, run_in_order);
  EXPECT_EQ(record.series.autocorrelation, std::vector<double>{12.5});
}

// -(sum of m ux uy + virial over time) / area, with u relative to the flow.
TEST(ShearedMeasures, StressIsThatOfMotionAndCollisions) {
  const Domain box = sheared_box(20.0, 10.0, 0.0);
  EXPECT_DOUBLE_EQ(shear_stress(30.0, 40.0, 2.0, box), -(30.0 + 20.0) / 200.0);
  EXPECT_EQ(shear_stress(30.0, 40.0, 0.0, box), 0.0);
}

// Two disks across the top, half a unit apart at the place of the images at the time of the sample.
TEST(ShearedMeasures, PairsOfASampleAreThoseOfItsTime) {
  Scene scene;
  scene.box = sheared_box(20.0, 10.0, 0.0);
  AnalysisPlan& plan = scene.analysis;
  plan.wanted[static_cast<std::size_t>(Quantity::pair_correlation)] = true;
  plan.pairs = {2.0, 2, 0.0};
  const Disks disks = test::disks_of({{5.0, 9.75, 0.0, 0.0, 0.1, 1.0}, {2.0, 0.25, 0.0, 0.0, 0.1, 1.0}});
  AnalysisRecord record = empty_record(scene);
  take_sample(record, scene, disks, 0.0, {}, run_in_order);
  EXPECT_EQ(record.pairs.counts, (std::vector<Count>{0, 0})) << "the disks are 3 apart along x";
  take_sample(record, scene, disks, 3.0, {}, run_in_order);
  EXPECT_EQ(record.pairs.counts, (std::vector<Count>{2, 0})) << "each disk counts the other";
}

// A disk rises through the box for ever while the flow carries it along: only (y - y_0)^2 counts.
TEST(ShearedMeasures, DisplacementIsAcrossTheFlow) {
  Domain box = sheared_box(10.0, 10.0, 0.0);
  Disks d;
  append(d, {1.0, 9.0, 3.0, 2.0, 0.5, 1.0, 0});
  append(d, {5.0, 5.0, 0.0, 0.0, 0.5, 1.0, 1});
  DisplacementTally tally;
  begin_displacement(tally, d, box, 0.0);
  double x = 1.0, y = 9.0;
  for (int k = 1; k <= 40; ++k) {
    x += 3.0 * 0.5;
    y += 2.0 * 0.5;
    box.move_images(0.5 * k);
    wrap_sheared(x, y, box.shear.offset, box);
    d.x[0] = x;
    d.y[0] = y;
    look_at(tally, d, box, 0.5 * k);
    const MeanSquare mean = mean_square_displacement(tally, d, box);
    EXPECT_NEAR(mean.value, 0.5 * k * k, 1e-9) << k;
    EXPECT_EQ(mean.disks, 2U);
  }
  EXPECT_EQ(tally.doubtful, 0U) << "jumps of images along x must not be doubtful";
}

// In one window of exact the disk rises fifteen times through a low and wide box: looks in between follow from the
// box's height.
TEST(ShearedMeasures, DisplacementIsFollowedByTheHeightOfTheBox) {
  Scene scene = test::scene_of(Method::exact, 40.0, 4.0, 0.0, 20.0);
  test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
  scene.box.shear = {0.01, 0.04, 0.0};
  const auto engine = make_reference_engine(scene, test::state_of(scene, {{5.0, 2.0, 0.0, 3.0, 0.4, 1.0}}));
  DisplacementTally tally;
  begin_displacement(tally, engine->state().disks, scene.box, 0.0);
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    const State& now = engine->state();
    if (follow_disks(tally, *engine, scene, now.time)) look_at(tally, now.disks, scene.box, now.time);
  }
  look_at(tally, engine->state().disks, scene.box, 20.0);
  EXPECT_NEAR(mean_square_displacement(tally, engine->state().disks, scene.box).value, 60.0 * 60.0, 1e-6);
  EXPECT_EQ(tally.doubtful, 0U);
}

}  // namespace
}  // namespace carom
