// [analysis] select: quantities of a group among other disks are those of the group alone; the mean pressure and
// collision rate are those of all disks.
#include <gtest/gtest.h>

#include <cmath>

#include "core/measure/analysis.hpp"
#include "core/measure/measured_disks.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

Scene scene_of_all_quantities() {
  Scene scene;
  scene.box = test::box_of(20.0, 10.0, test::Periodic::both);
  AnalysisPlan& plan = scene.analysis;
  plan.wanted.fill(true);
  plan.pairs = plan.bonds = {4.0, 8, 0.0};
  plan.speed_max = 5.0;
  plan.speed_bins = plan.density_bins = plan.profile_bins = plan.wave_numbers = 6;
  plan.density_every = plan.profile_every = 1.0;
  return scene;
}

class Selection : public testing::Test {
 protected:
  // Two samples of sixty disks, of which all but every sixth belong to the group, and two samples of the group alone.
  Selection() : scene_(scene_of_all_quantities()), of_group_(scene_), all_(empty_record(scene_)) {
    of_group_.analysis.group = "some";
    of_group_.analysis.ids = {20, 50};
    selected_ = empty_record(of_group_);
    alone_ = empty_record(scene_);
    test::Draws draws(41);
    State now;
    for (const double t : {0.0, 2.0}) {
      Disks disks = test::disks_of(test::random_disks(draws, scene_.box, 60, {0.1, 0.3, 1.0, 4.0, 2.0}));
      now.time = now.counters.disk_time = t;
      now.counters.virial = 30.0 * t;
      now.counters.collisions = static_cast<Count>(7.0 * t);
      take_sample(all_, scene_, disks, t, now, run_in_order);
      take_sample(selected_, of_group_, disks, t, now, run_in_order);
      take_sample(alone_, scene_, disks_of(disks, of_group_.analysis.ids), t, now, run_in_order);
    }
  }

  Scene scene_, of_group_;
  AnalysisRecord all_, selected_, alone_;
};

TEST_F(Selection, SeriesAreThoseOfTheGroup) {
  const SampleSeries& found = selected_.series;
  const SampleSeries& expected = alone_.series;
  EXPECT_EQ(found.disks, (std::vector<double>{30.0, 30.0}));
  EXPECT_EQ(found.followed, expected.followed);
  EXPECT_EQ(found.displacement, expected.displacement);
  EXPECT_EQ(found.temperature, expected.temperature);
  EXPECT_EQ(found.autocorrelation, expected.autocorrelation);
  EXPECT_EQ(found.local_order, expected.local_order);
  EXPECT_EQ(found.global_order, expected.global_order);
  EXPECT_EQ(found.bond_autocorrelation, expected.bond_autocorrelation);
  EXPECT_NE(found.local_order, all_.series.local_order);
}

TEST_F(Selection, CurvesAreThoseOfTheGroup) {
  EXPECT_EQ(selected_.pairs.counts, alone_.pairs.counts);
  EXPECT_EQ(selected_.pairs.expected, alone_.pairs.expected);
  EXPECT_EQ(selected_.bonds.pairs, alone_.bonds.pairs);
  EXPECT_EQ(selected_.bonds.product, alone_.bonds.product);
  EXPECT_EQ(selected_.speeds.counts, alone_.speeds.counts);
  EXPECT_EQ(selected_.structure.along_x, alone_.structure.along_x);
  EXPECT_EQ(selected_.structure.along_y, alone_.structure.along_y);
  EXPECT_EQ(selected_.density.centres, alone_.density.centres);
  EXPECT_EQ(selected_.density.covered, alone_.density.covered);
  EXPECT_EQ(selected_.motion.px, alone_.motion.px);
  EXPECT_EQ(selected_.motion.twice_thermal, alone_.motion.twice_thermal);
  ASSERT_EQ(selected_.motion_rows.size(), 3U);
  EXPECT_EQ(selected_.motion_rows[2].disks, alone_.motion_rows[2].disks);
  EXPECT_EQ(selected_.density_rows[2].covered, alone_.density_rows[2].covered);
}

TEST_F(Selection, MeansAreThoseOfAllDisks) {
  ASSERT_EQ(selected_.series.pressure.size(), 2U);
  EXPECT_EQ(selected_.series.pressure[1], all_.series.pressure[1]);
  EXPECT_NE(selected_.series.pressure[1], alone_.series.pressure[1]);
  EXPECT_EQ(selected_.series.collision_rate[1], 14.0);
}

// A record read from a file is continued only if each of its series has all samples.
TEST_F(Selection, ARecordThatLacksASampleOfOneSeriesGoesWithNoScene) {
  ASSERT_TRUE(goes_with(all_, scene_));
  using Series = std::vector<double> SampleSeries::*;
  for (const Series series :
       {&SampleSeries::time, &SampleSeries::disks, &SampleSeries::interval, &SampleSeries::displacement,
        &SampleSeries::followed, &SampleSeries::pressure, &SampleSeries::collision_rate, &SampleSeries::temperature,
        &SampleSeries::autocorrelation, &SampleSeries::local_order, &SampleSeries::global_order,
        &SampleSeries::bond_autocorrelation}) {
    AnalysisRecord record = all_;
    (record.series.*series).pop_back();
    EXPECT_FALSE(goes_with(record, scene_));
  }
}

// Means exclude what happened before the first sample, however long that took.
TEST(FirstSample, HasNoMeans) {
  Scene scene = scene_of_all_quantities();
  AnalysisRecord record = empty_record(scene);
  test::Draws draws(42);
  const Disks disks = test::disks_of(test::random_disks(draws, scene.box, 20, {0.1, 0.3, 1.0, 4.0, 2.0}));
  State now;
  now.time = now.counters.disk_time = 5.0;
  now.counters.virial = 30.0;
  now.counters.collisions = 7;
  take_sample(record, scene, disks, now.time, now, run_in_order);
  EXPECT_EQ(record.series.interval, std::vector<double>{0.0});
  EXPECT_TRUE(std::isnan(record.series.pressure.at(0)));
  EXPECT_TRUE(std::isnan(record.series.collision_rate.at(0)));
  now.time = now.counters.disk_time = 7.0;
  now.counters.collisions = 9;
  take_sample(record, scene, disks, now.time, now, run_in_order);
  EXPECT_EQ(record.series.interval.at(1), 2.0);
  EXPECT_EQ(record.series.collision_rate.at(1), 2.0);
}

// With fewer than seven disks there is no psi6: a sample with so few has no pairs, and must not affect the next.
TEST(BondCorrelation, LeavesOutSamplesOfSixDisks) {
  const Scene scene = scene_of_all_quantities();
  test::Draws draws(43);
  const auto disks = [&](std::size_t count) {
    return test::disks_of(test::random_disks(draws, scene.box, count, {0.1, 0.3, 1.0, 4.0, 2.0}));
  };
  AnalysisRecord record = empty_record(scene), fresh = record;
  take_sample(record, scene, disks(6), 0.0, {}, run_in_order);
  EXPECT_EQ(record.bonds.samples, 0U);
  const Disks more = disks(40);
  take_sample(record, scene, more, 1.0, {}, run_in_order);
  take_sample(fresh, scene, more, 1.0, {}, run_in_order);
  EXPECT_EQ(record.bonds.samples, 1U);
  EXPECT_EQ(record.bonds.pairs, fresh.bonds.pairs);
  EXPECT_EQ(record.bonds.product, fresh.bonds.product);
}

}  // namespace
}  // namespace carom
