// The density along an axis and the histogram of speeds, compared with results known beforehand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/measure/analysis_curves.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

TEST(DensityProfile, ShareBelowALine) {
  EXPECT_EQ(share_below(-2.0), 0.0);
  EXPECT_EQ(share_below(1.0), 1.0);
  EXPECT_NEAR(share_below(0.0), 0.5, 1e-15);
  for (const double h : {-0.9, -0.3, 0.2, 0.7}) {
    EXPECT_NEAR(share_below(h) + share_below(-h), 1.0, 1e-15);
    double sum = 0.0;  // sum over thin strips
    constexpr int strips = 100000;
    for (int k = 0; k < strips; ++k) {
      const double y = -1.0 + (h + 1.0) * (k + 0.5) / strips;
      sum += 2.0 * std::sqrt(1.0 - y * y) * (h + 1.0) / strips;
    }
    EXPECT_NEAR(share_below(h), sum / std::numbers::pi, 1e-7) << h;
  }
}

// A disk across a periodic side, a disk across two slabs, and a disk beyond a wall of a box that is periodic along the
// other axis: no area is lost.
TEST(DensityProfile, AreaIsSharedOutAndNoneIsLost) {
  for (const bool along_x : {true, false}) {
    Domain box{8.0, 8.0};
    test::set_sides(box, SideKind::periodic, SideKind::wall);
    DensityProfile profile{std::vector<Count>(4, 0), std::vector<double>(4, 0.0), 0};
    const Disks disks = test::disks_of({{0.25, 0.25, 0.0, 0.0, 1.0, 1.0}, {4.0, 4.0, 0.0, 0.0, 0.5, 1.0}});
    add_density(profile, disks, box, along_x);
    add_density(profile, disks, box, along_x);
    const double corner = along_x ? std::numbers::pi * share_below(-0.25) : 0.0;
    EXPECT_EQ(profile.centres, (std::vector<Count>{2, 0, 2, 0}));
    EXPECT_NEAR(profile.covered[0], 2.0 * (std::numbers::pi - corner), 1e-12);
    EXPECT_NEAR(profile.covered[3], 2.0 * corner, 1e-12);
    EXPECT_NEAR(profile.covered[1], std::numbers::pi * 0.25, 1e-12);
    EXPECT_NEAR(profile.covered[2], std::numbers::pi * 0.25, 1e-12);
  }
}

// The rows of a run from 1 to 6 are [1, 3), [3, 5), [5, 6]; a sample at an edge belongs to the later row, the last one
// to the last row, and the rows add up to the whole.
TEST(Profiles, RowsDivideTheRun) {
  Scene scene;
  scene.box = {12.0, 8.0};
  scene.run.t_end = 6.0;
  AnalysisPlan& plan = scene.analysis;
  plan.wanted[static_cast<std::size_t>(Quantity::density)] = plan.wanted[static_cast<std::size_t>(Quantity::profile)] =
      true;
  plan.start = 1.0;
  plan.density_bins = plan.profile_bins = 4;
  plan.density_every = plan.profile_every = 2.0;
  AnalysisRecord record = empty_record(scene);
  for (int k = 0; k <= 5; ++k) {
    const Disks disks = test::disks_of({{4.0, 1.0 + k, 2.0 * k, 0.0, 0.5, 1.0}});
    take_sample(record, scene, disks, 1.0 + k, {}, run_in_order);
  }
  ASSERT_EQ(record.motion_rows.size(), 3U);
  ASSERT_EQ(record.density_rows.size(), 3U);
  const std::vector<Count> samples{2, 2, 2};
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(record.motion_rows[row].samples, samples[row]);
    EXPECT_EQ(record.density_rows[row].samples, samples[row]);
  }
  EXPECT_EQ(record.motion_rows[1].disks, (std::vector<Count>{0, 1, 1, 0})) << "the disk is at y = 3 and 4";
  EXPECT_EQ(profile_curves(record.motion_rows[1], scene).vx[1], 4.0);
  EXPECT_EQ(row_times(3, 2.0, scene), (std::vector<double>{1.0, 3.0, 5.0}));
  EXPECT_EQ(profile_curves(record.motion, scene).position, (std::vector<double>{1.0, 3.0, 5.0, 7.0})) << "along y";
  EXPECT_EQ(packing_curve(record.density, scene).middle, (std::vector<double>{1.0, 3.0, 5.0, 7.0}));
  for (std::size_t slab = 0; slab < 4; ++slab) {
    Count disks = 0;
    for (const DensityProfile& row : record.density_rows) disks += row.centres[slab];
    EXPECT_EQ(record.density.centres[slab], disks);
  }
}

// The number of samples in each row of a density profile, with a row for each `every` of a run over these times.
std::vector<Count> samples_of_rows(const std::vector<double>& times, double every) {
  Scene scene;
  scene.box = {8.0, 8.0};
  scene.run.t_end = times.back();
  AnalysisPlan& plan = scene.analysis;
  plan.wanted[static_cast<std::size_t>(Quantity::density)] = true;
  plan.start = times.front();
  plan.density_bins = 4;
  plan.density_every = every;
  AnalysisRecord record = empty_record(scene);
  const Disks disks = test::disks_of({{4.0, 1.0, 0.0, 0.0, 0.5, 1.0}});
  for (const double t : times) take_sample(record, scene, disks, t, {}, run_in_order);
  std::vector<Count> samples;
  for (const DensityProfile& row : density_rows_of_run(record, scene)) samples.push_back(row.samples);
  return samples;
}

// If the run ends at an edge there is no row beyond it.
TEST(Profiles, TheLastMomentBelongsToTheLastRow) {
  EXPECT_EQ(samples_of_rows({1.0, 2.0, 3.0, 4.0, 5.0}, 2.0), (std::vector<Count>{2, 3}))
      << "the last row has the samples at 3, 4 and 5";
}

// A run that ends where its analysis begins has one sample and one row.
TEST(Profiles, ARunOfNoLengthHasARow) {
  EXPECT_EQ(samples_of_rows({1.0}, 2.0), (std::vector<Count>{1}));
}

// Rounded times may be a little beside the edges at which they should be: (0.9 - 0.8) / 0.1 is less than 1, and (1.1 -
// 0.8) / 0.1 more than 3.
TEST(Profiles, RowsBeginWhereTheyAreMeantTo) {
  EXPECT_EQ(samples_of_rows({0.8, 0.9, 1.0, 1.1}, 0.1), (std::vector<Count>{1, 1, 2}))
      << "the last row has the samples at 1.0 and 1.1";
}

// A run continued to a later end has the rows of a run with that end from the start: its former last sample, at an
// edge, belongs to the row that begins there.
TEST(Profiles, ALaterEndHasTheRowsOfAWholeRun) {
  Scene scene;
  scene.box = {8.0, 8.0};
  AnalysisPlan& plan = scene.analysis;
  plan.wanted[static_cast<std::size_t>(Quantity::density)] = plan.wanted[static_cast<std::size_t>(Quantity::profile)] =
      true;
  plan.density_bins = plan.profile_bins = 4;
  plan.density_every = plan.profile_every = 2.0;
  const auto sample = [&](AnalysisRecord& record, double t) {
    take_sample(record, scene, test::disks_of({{4.0, 1.0 + t, t * t, 1.0, 0.5, 1.0 + t}}), t, {}, run_in_order);
  };
  const auto samples_of = [](const auto& rows) {
    std::vector<Count> samples;
    for (const auto& row : rows) samples.push_back(row.samples);
    return samples;
  };
  scene.run.t_end = 4.0;
  AnalysisRecord record = empty_record(scene);
  for (int t = 0; t <= 4; ++t) sample(record, t);
  EXPECT_EQ(samples_of(density_rows_of_run(record, scene)), (std::vector<Count>{2, 3}));
  EXPECT_EQ(samples_of(motion_rows_of_run(record, scene)), (std::vector<Count>{2, 3}));
  scene.run.t_end = 6.0;
  for (int t = 5; t <= 6; ++t) sample(record, t);
  const std::vector<DensityProfile> density = density_rows_of_run(record, scene);
  const std::vector<MotionProfile> motion = motion_rows_of_run(record, scene);
  EXPECT_EQ(samples_of(density), (std::vector<Count>{2, 2, 3}));
  EXPECT_EQ(samples_of(motion), (std::vector<Count>{2, 2, 3}));
  EXPECT_EQ(density[2].centres, (std::vector<Count>{0, 0, 1, 2})) << "the disk is at y = 5, 6 and 7";
}

// Parts of any kind, joined, are the profile of all samples, including the temperature relative to the mean of all.
TEST(Profiles, JoinedPartsAreTheWhole) {
  test::Draws draws(7);
  const Domain box{10.0, 10.0};
  MotionProfile whole = empty_profile(3), first = empty_profile(3), rest = empty_profile(3);
  DensityProfile filled = empty_density(3), filled_first = empty_density(3), filled_rest = empty_density(3);
  for (int k = 0; k < 5; ++k) {
    Disks disks = test::disks_of(test::random_disks(draws, box, 8, {0.1, 0.5}));
    for (std::size_t i = 0; i < disks.size(); ++i) disks.vx[i] += 3.0 * k;
    for (MotionProfile* part : {&whole, k < 2 ? &first : &rest}) add_motion(*part, disks, box, false);
    for (DensityProfile* part : {&filled, k < 2 ? &filled_first : &filled_rest}) add_density(*part, disks, box, false);
  }
  join(first, rest);
  join(filled_first, filled_rest);
  EXPECT_EQ(first.disks, whole.disks);
  EXPECT_EQ(first.samples, 5U);
  EXPECT_EQ(filled_first.centres, filled.centres);
  EXPECT_EQ(filled_first.samples, 5U);
  for (std::size_t k = 0; k < 3; ++k) {
    const SlabMotion joined = motion_of_slab(first, k), all = motion_of_slab(whole, k);
    EXPECT_NEAR(joined.velocity.x, all.velocity.x, 1e-12);
    EXPECT_NEAR(joined.velocity.y, all.velocity.y, 1e-12);
    EXPECT_NEAR(joined.temperature, all.temperature, 1e-12 * all.temperature);
    EXPECT_NEAR(filled_first.covered[k], filled.covered[k], 1e-12);
  }
}

// The sums are the same for any order of storage.
TEST(DensityProfile, StorageOrderChangesNoBit) {
  test::Draws draws(3);
  const Domain box{10.0, 10.0};
  std::vector<Disk> list = test::random_disks(draws, box, 40, {0.1, 0.5});
  const auto covered = [&](const std::vector<Disk>& disks) {
    DensityProfile profile{std::vector<Count>(30, 0), std::vector<double>(30, 0.0), 0};
    add_density(profile, test::disks_of(disks), box, false);
    return profile.covered;
  };
  std::vector<Disk> turned(list.rbegin(), list.rend());
  EXPECT_EQ(covered(list), covered(turned));
}

// If one of two disks weighs nothing compared with the other, the heavy one's energy is nearly all that of the mean
// velocity, and rounding may make the difference negative.
TEST(MotionProfile, RoundingMakesNoNegativeTemperature) {
  MotionProfile profile = empty_profile(1);
  const Disks disks = test::disks_of({{1.0, 1.0, 0.0, 0.0, 0.1, 1e-30}, {3.0, 1.0, 1.7, 0.0, 0.1, 1.2}});
  add_motion(profile, disks, test::box_of(4.0, 4.0), false);
  EXPECT_EQ(motion_of_slab(profile, 0).temperature, 0.0);
}

TEST(SpeedHistogram, CountsReducedSpeeds) {
  SpeedHistogram h;
  h.counts.assign(4, 0);
  // v^2 m / T is 1, 4 and 100 at T = 2, so u = 1, 2, 10.
  const Disks disks =
      test::disks_of({{0, 0, 1.0, 0.0, 1.0, 2.0}, {0, 0, 0.0, -1.0, 1.0, 8.0}, {0, 0, 6.0, 8.0, 1.0, 2.0}});
  add_speeds(h, disks, 2.0, 4.0);
  EXPECT_EQ(h.counts, (std::vector<Count>{0, 1, 1, 0}));
  EXPECT_EQ(h.beyond, 1U);
  EXPECT_EQ(h.largest_seen, 10.0);
  add_speeds(h, disks, 0.0, 4.0);
  EXPECT_EQ(h.samples, 1U) << "with all disks at rest there is no scale";
  // Bins of width 1 with one of three disks each; a disk beyond the last bin counts as a sample like the others.
  AnalysisRecord record;
  record.speeds = h;
  AnalysisPlan plan;
  plan.speed_max = 4.0;
  EXPECT_EQ(speed_curve(record, plan).value, (std::vector<double>{0.0, 1.0 / 3.0, 1.0 / 3.0, 0.0}));
  // The same disks at four times the temperature: u = 0.5, 1, 5.
  add_speeds(h, disks, 8.0, 4.0);
  EXPECT_EQ(h.counts, (std::vector<Count>{1, 2, 1, 0}));
  EXPECT_EQ(h.beyond, 2U);
  EXPECT_EQ(h.largest_seen, 10.0);
  EXPECT_EQ(h.samples, 2U);
  EXPECT_EQ(h.temperature_sum, 10.0);
}

TEST(SpeedHistogram, MaxwellSharesMakeUpAll) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 90; ++k) {
    const double share = maxwell_share(9.0, 90, k);
    const double u = 0.1 * (static_cast<double>(k) + 0.5);
    EXPECT_NEAR(share / (0.1 * u * std::exp(-0.5 * u * u)), 1.0, 0.05) << k;
    sum += share;
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);
}

}  // namespace
}  // namespace carom
