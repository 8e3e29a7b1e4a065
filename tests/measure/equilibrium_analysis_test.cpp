// The quantities measured in an equilibrium run, compared with published numbers: contact value of g(r), pressure,
// Maxwell's distribution.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "core/base/column.hpp"
#include "core/base/sample_mean.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/analysis_curves.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "parallel/threads/executor.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// Disks of two masses at packing fraction 0.3, whose speeds are far from Maxwell's at the start.
constexpr const char* gas = R"(
[box]
packing_fraction = 0.3
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[[disks]]
count = 1024
positions = "random"
velocities = { uniform = 1.0 }
radius = 0.5
mass = 1.0
[[disks]]
count = 1024
positions = "random"
velocities = { uniform = 1.0 }
radius = 0.5
mass = 4.0
[run]
t_end = 130.0
[analysis]
what = ["pair_correlation", "speeds", "pressure"]
pair_correlation = { r_max = 4.0, bins = 200 }
)";

// Pearson's chi^2 of the histogram and Maxwell's distribution, over the bins in which 20 or more are expected, and the
// number of these bins.
struct ChiSquare {
  double value = 0.0, bins = 0.0;
};
ChiSquare chi_square(const SpeedHistogram& h, const AnalysisPlan& plan) {
  double all = static_cast<double>(h.beyond);
  for (const Count c : h.counts) all += static_cast<double>(c);
  ChiSquare chi;
  for (std::size_t k = 0; k < h.counts.size(); ++k) {
    const double expected = all * maxwell_share(plan.speed_max, h.counts.size(), k);
    if (expected < 20.0) continue;
    const double off = static_cast<double>(h.counts[k]) - expected;
    chi.value += off * off / expected;
    chi.bins += 1.0;
  }
  return chi;
}

// chi^2 has the mean `bins` and the variance 2 bins; five standard deviations more occur by chance once in 10^6.
double bound(const ChiSquare& chi) {
  return chi.bins + 5.0 * std::sqrt(2.0 * chi.bins);
}

// The parabola a + b s + c s^2 fitted to the first `points` values of the curve from `from` on, evaluated at s = 0, at
// contact.
double at_contact(const BinnedCurve& g, std::size_t from, std::size_t points, double contact) {
  const auto first = static_cast<Eigen::Index>(from), count = static_cast<Eigen::Index>(points);
  const Column s = column_of(g.middle).segment(first, count) - contact;
  Eigen::MatrixX3d powers(count, 3);
  powers << Column::Ones(count), s, s.square();
  return powers.colPivHouseholderQr().solve(column_of(g.value).segment(first, count).matrix())[0];
}

TEST(EquilibriumAnalysis, ContactValuePressureAndSpeedsAreThoseOfTheory) {
  const Scene scene = parse_scene(gas, "gas.toml", "");
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2});
  AnalysisRecord record = empty_record(scene), start = record, seldom = record;
  const BlockRunner run = blocks_on_threads(2);
  take_sample(start, scene, engine->state().disks, 0.0, engine->state(), run);
  const ChiSquare before = chi_square(start.speeds, scene.analysis);
  EXPECT_GT(before.value, 2.0 * bound(before)) << "the speeds at the start must differ from Maxwell's";
  Disks disks;
  int taken = 0;
  for (double t = 10.0; t < 130.0; t += 0.25, ++taken) {
    while (engine->state().time < t) engine->step();
    engine->disks_at(t, disks);
    take_sample(record, scene, disks, t, engine->state(), run);
    // Speeds are sampled a few collisions apart, so that samples are independent.
    if (taken % 8 == 0) add_speeds(seldom.speeds, disks, record.series.temperature.back(), scene.analysis.speed_max);
  }
  constexpr double z = 2.06326;  // virial series at 0.3
  const double area = scene.box.width * scene.box.height;
  const double temperature = sample_mean(record.series.temperature).mean;
  EXPECT_NEAR(sample_mean(record.series.pressure).mean * area / (2048.0 * temperature), z, 0.01 * z);
  // Z = 1 + 2 phi g(2 r) for equal disks. Contact is at distance 1, the end of bin 49.
  const BinnedCurve g = pair_correlation_curve(record.pairs, scene.analysis);
  EXPECT_EQ(record.pairs.counts[48], 0U) << "no pair overlaps";
  const double contact = (z - 1.0) / (2.0 * 0.3);
  EXPECT_NEAR(at_contact(g, 50, 15, 1.0), contact, 0.02 * contact);
  // At large distances there is no order left.
  double far = 0.0;
  for (std::size_t k = 175; k < 200; ++k) far += g.value[k] / 25.0;
  EXPECT_NEAR(far, 1.0, 0.005);
  const ChiSquare after = chi_square(seldom.speeds, scene.analysis);
  EXPECT_GT(after.bins, 35.0);
  EXPECT_LT(after.value, bound(after));
}

// u / dt is not a velocity: a pressure computed from it would depend on dt. Collisions are counted nevertheless.
TEST(EquilibriumAnalysis, BrownianMotionHasNoPressure) {
  Scene scene = test::scene_of(Method::pairwise, 10.0, 10.0, 0.01, 1.0);
  scene.physics.diffusion = 1.0;
  for (const Quantity q : {Quantity::pressure, Quantity::collision_rate}) {
    scene.analysis.wanted[static_cast<std::size_t>(q)] = true;
  }
  const Disks disks = test::disks_of({{5.0, 5.0, 3.0, 4.0, 0.5, 1.0}});
  AnalysisRecord record = empty_record(scene);
  State now;
  take_sample(record, scene, disks, 0.0, now, run_in_order);
  now.time = now.counters.disk_time = 1.0;
  now.counters.collisions = 3;
  take_sample(record, scene, disks, 1.0, now, run_in_order);
  ASSERT_EQ(record.series.pressure.size(), 2U);
  EXPECT_TRUE(std::isnan(record.series.pressure[1]));
  EXPECT_EQ(record.series.collision_rate[1], 6.0);
}

}  // namespace
}  // namespace carom
