// The numbers and attributes of analysis.h5, for a record made by hand.
#include "io/tables/analysis_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/blocking_error.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/measured_means.hpp"
#include "io/tables/analysis_curves.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

constexpr int samples = 64;

// 64 samples, one unit of time apart, and two rows of each profile. more: keys of the box.
Scene measured_scene(const std::string& more) {
  return parse_scene(
      "[box]\nwidth = 8.0\nheight = 4.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\n" +
          more +
          "[[disks]]\nname = \"a\"\ncount = 10\npositions = \"random\"\nradius = 0.1\nmass = 1.0\n"
          "[[disks]]\nname = \"b\"\ncount = 5\npositions = \"random\"\nradius = 0.1\nmass = 1.0\n"
          "[run]\nmethod = \"exact\"\nt_end = 63.0\n[analysis]\nwhat = [\"pair_correlation\", \"displacement\", "
          "\"speeds\", \"density\", \"pressure\", \"collision_rate\", \"profile\", \"bond_order\", "
          "\"structure_factor\", \"velocity_autocorrelation\", \"bond_correlation\", \"bond_autocorrelation\"]\n"
          "every = 1.0\npair_correlation = { r_max = 1.5, bins = 3, groups = [\"a\", \"b\"] }\n"
          "structure_factor = { wave_numbers = 2 }\nbond_correlation = { r_max = 1.0, bins = 2 }\n"
          "density = { bins = 2, every = 32.0 }\nprofile = { bins = 2, every = 40.0, axis = \"x\" }\n",
      "scene", "");
}

// Samples that are equal in pairs: half as many independent ones as there seem to be.
double in_pairs(int k) {
  return k % 4 < 2 ? 3.0 : 1.0;
}

// The mean square displacement rises by 3 in each unit of time.
AnalysisRecord made_by_hand(const Scene& scene) {
  AnalysisRecord record = empty_record(scene);
  SampleSeries& s = record.series;
  for (int k = 0; k < samples; ++k) {
    s.time.push_back(k);
    s.disks.push_back(10.0);
    s.displacement.push_back(3.0 * k);
    s.followed.push_back(8.0);
    s.temperature.push_back(1.5);
    s.interval.push_back(k == 0 ? 2.0 : 1.0);
    s.pressure.push_back(in_pairs(k));
    s.collision_rate.push_back(in_pairs(k + 1));
    s.local_order.push_back(0.1 * in_pairs(k));
    s.global_order.push_back(0.01 * in_pairs(k));
    s.autocorrelation.push_back(100.0 - k);
    s.bond_autocorrelation.push_back(1.0 - 0.01 * k);
  }
  record.displacement.doubtful = 5;
  record.pairs.centres = 7 * samples;
  record.pairs.counts = {10, 20, 30};
  for (const Count of_groups : {1U, 2U, 3U}) record.partial[of_groups - 1].counts = {of_groups, 0, 7 * of_groups};
  record.structure = {{2.0, 4.0}, {6.0, 8.0}, 2};
  record.bonds = {{3.0, 1.0}, {4, 2}, samples};
  record.speeds.samples = samples;
  record.speeds.beyond = 6;
  record.speeds.temperature_sum = 1.5 * samples;
  record.density = {{8, 4}, {2.0, 1.0}, 4};
  record.density_rows = {{{4, 2}, {1.0, 0.5}, 2}, {{4, 2}, {1.0, 0.5}, 2}};
  record.motion = {{2, 2}, {2.0, 2.0}, {2.0, 4.0}, {6.0, 8.0}, {0.0, 0.0}, 2};
  record.motion_rows = {{{1, 1}, {1.0, 1.0}, {1.0, 2.0}, {3.0, 4.0}, {0.0, 0.0}, 1},
                        {{1, 1}, {1.0, 1.0}, {1.0, 2.0}, {5.0, 6.0}, {0.0, 0.0}, 1}};
  return record;
}

class AnalysisFile : public ::testing::Test {
 protected:
  void write(const std::string& more) {
    const Scene scene = measured_scene(more);
    write(scene, made_by_hand(scene));
  }
  void write(const Scene& scene, const AnalysisRecord& record) {
    write_analysis(path_, scene, record);
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    ASSERT_GE(file_, 0);
  }
  void TearDown() override { H5Fclose(file_); }

  std::vector<double> numbers(const char* path) const {
    const hid_t set = H5Dopen2(file_, path, H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }
  double number(const char* object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT);
    double value = std::nan("");
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
  std::string word(const char* object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
    return text.c_str();
  }

  test::TestFolder folder_{"analysis_file"};
  const std::string path_ = (folder_.path() / "analysis.h5").string();

 private:
  hid_t file_ = -1;
};

TEST_F(AnalysisFile, SeriesHaveTheirMeansAndErrors) {
  write("");
  const SampleSeries series = made_by_hand(measured_scene("")).series;
  EXPECT_EQ(numbers("/samples/disks"), series.disks);
  EXPECT_EQ(numbers("/displacement/disks"), series.followed) << "disks that still exist";
  EXPECT_EQ(number("/displacement", "doubtful"), 5.0);
  EXPECT_DOUBLE_EQ(number("/displacement", "diffusion"), 3.0 / 4.0) << "4 D t in two dimensions";
  // The first 3 counts for twice as long as the other samples.
  EXPECT_DOUBLE_EQ(number("/pressure", "mean"), (2.0 * samples + 3.0) / (samples + 1.0));
  // The samples are correlated, so the error by blocking is sqrt(2) times that of independent ones. It belongs to this
  // mean: 32 blocks, 3 and 1 in turn, of which the first weighs 3 and the others 2.
  EXPECT_DOUBLE_EQ(number("/pressure", "standard_error"), blocking_error(series.pressure, series.interval));
  const double mean = 131.0 / 65.0,
               squares = (9.0 + 15.0 * 4.0) * std::pow(3.0 - mean, 2) + 64.0 * std::pow(1.0 - mean, 2);
  EXPECT_NEAR(number("/pressure", "standard_error"), std::sqrt(squares * 32.0 / 31.0) / 65.0, 1e-12);
  EXPECT_NEAR(number("/bond_order", "local_standard_error"), 0.1 / std::sqrt(31.0), 1e-12);
  EXPECT_DOUBLE_EQ(number("/bond_order", "global_mean"), 0.02);
}

// The means that the run's summary contains.
TEST_F(AnalysisFile, HasTheMeansOfTheSummary) {
  const Scene scene = measured_scene("");
  const AnalysisRecord record = made_by_hand(scene);
  write(scene, record);
  const std::vector<MeasuredMean> means = measured_means(record, scene);
  ASSERT_EQ(means.size(), 5U);
  const auto expect = [&](std::size_t k, const char* name, const char* group, const char* value, const char* error) {
    EXPECT_EQ(means[k].name, name);
    EXPECT_EQ(means[k].value, number(group, value));
    EXPECT_EQ(means[k].error, number(group, error));
  };
  expect(0, "pressure", "/pressure", "mean", "standard_error");
  expect(1, "collision_rate", "/collision_rate", "mean", "standard_error");
  expect(2, "diffusion", "/displacement", "diffusion", "diffusion_error");
  expect(3, "bond_order_local", "/bond_order", "local_mean", "local_standard_error");
  expect(4, "bond_order_global", "/bond_order", "global_mean", "global_standard_error");
  for (const MeasuredMean& none : measured_means(empty_record(scene), scene)) {
    EXPECT_TRUE(std::isnan(none.value) && std::isnan(none.error)) << none.name << " without samples";
  }
}

// A mean that no further sample would give has another reason.
TEST_F(AnalysisFile, AMeanThatIsMissingHasItsReason) {
  Scene scene = measured_scene("");
  const auto reasons = [&](const AnalysisRecord& record) {
    std::vector<std::string> all;
    for (const MeasuredMean& mean : measured_means(record, scene)) {
      if (std::isnan(mean.value)) all.emplace_back(mean.missing);
    }
    return all;
  };
  EXPECT_THAT(reasons(empty_record(scene)), ::testing::Each("there are too few samples"));
  AnalysisRecord record = made_by_hand(scene);
  EXPECT_THAT(reasons(record), ::testing::IsEmpty());
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::size_t taken = record.series.time.size();
  record.series.displacement.back() = nothing;  // as all disks that were followed are gone
  record.series.local_order.assign(taken, nothing);
  record.series.global_order.assign(taken, nothing);
  record.series.disks.assign(taken, 6.0);
  EXPECT_THAT(reasons(record),
              ::testing::ElementsAre("the disks of the first sample are gone", "there are fewer than seven disks",
                                     "there are fewer than seven disks"));
  record.series.followed.front() = 0.0;
  EXPECT_THAT(reasons(record), ::testing::Contains("the first sample had no disks"));
  record.series.collision_rate.assign(taken, nothing);
  record.series.disks.assign(taken, 0.0);
  EXPECT_THAT(reasons(record), ::testing::Contains("there are no disks"));
  scene.physics.diffusion = 0.1;
  record.series.pressure.assign(taken, nothing);
  EXPECT_THAT(reasons(record), ::testing::Contains("Brownian disks have no velocities"));
}

TEST_F(AnalysisFile, CountsAreOverTheSamples) {
  write("");
  EXPECT_EQ(number("/pair_correlation", "centres"), 7.0) << "mean number";
  EXPECT_EQ(number("/speeds", "beyond"), 6.0);
  EXPECT_EQ(number("/speeds", "temperature"), 1.5);
  EXPECT_EQ(word("/density", "axis"), "y");
  EXPECT_EQ(word("/profile", "axis"), "x");
}

TEST_F(AnalysisFile, ProfilesSayAlongWhichAxis) {
  Scene scene = measured_scene("");
  scene.analysis.density_along_x = true;
  scene.analysis.profile_along_x = false;
  write(scene, made_by_hand(scene));
  EXPECT_EQ(word("/density", "axis"), "x");
  EXPECT_EQ(word("/profile", "axis"), "y");
}

TEST_F(AnalysisFile, RowsOfProfilesStandOneAfterTheOther) {
  write("");
  // Slabs of 8 x 2, with two samples in a row.
  EXPECT_EQ(numbers("/density/rows/number_density"), (std::vector<double>{0.125, 0.0625, 0.125, 0.0625}));
  EXPECT_EQ(numbers("/density/rows/packing_fraction"), (std::vector<double>{0.03125, 0.015625, 0.03125, 0.015625}));
  EXPECT_EQ(numbers("/profile/rows/velocity_x"), (std::vector<double>{1.0, 2.0, 1.0, 2.0}));
  EXPECT_EQ(numbers("/profile/rows/velocity_y"), (std::vector<double>{3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(numbers("/profile/position"), (std::vector<double>{2.0, 6.0}));
}

// Displacements across a shear flow are along y only: 2 D t.
TEST_F(AnalysisFile, DiffusionAcrossAShearFlowIsThatOfOneDimension) {
  write("shear_rate = 0.1\n");
  EXPECT_DOUBLE_EQ(number("/displacement", "diffusion"), 3.0 / 2.0);
}

TEST_F(AnalysisFile, EachCurveIsItsOwn) {
  write("");
  const SampleSeries series = made_by_hand(measured_scene("")).series;
  constexpr double pi = std::numbers::pi;
  EXPECT_EQ(numbers("/profile/velocity_x"), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(numbers("/profile/velocity_y"), (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(numbers("/density/centres"), (std::vector<double>{8.0, 4.0}));
  EXPECT_EQ(numbers("/density/number_density"), (std::vector<double>{0.125, 0.0625}));
  EXPECT_EQ(numbers("/structure_factor/kx"), (std::vector<double>{2.0 * pi / 8.0, 4.0 * pi / 8.0}));
  EXPECT_EQ(numbers("/structure_factor/ky"), (std::vector<double>{2.0 * pi / 4.0, 4.0 * pi / 4.0}));
  EXPECT_EQ(numbers("/structure_factor/along_x"), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(numbers("/structure_factor/along_y"), (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(numbers("/velocity_autocorrelation/value"), series.autocorrelation);
  EXPECT_EQ(numbers("/bond_autocorrelation/value"), series.bond_autocorrelation);
  EXPECT_EQ(numbers("/bond_correlation/r"), (std::vector<double>{0.25, 0.75}));
  EXPECT_EQ(numbers("/bond_correlation/g6"), (std::vector<double>{0.75, 0.5}));
  EXPECT_EQ(numbers("/bond_correlation/pairs"), (std::vector<double>{4.0, 2.0}));
  EXPECT_EQ(numbers("/pair_correlation/pairs"), (std::vector<double>{10.0, 20.0, 30.0}));
  EXPECT_EQ(number("/pair_correlation", "bin_width"), 0.5);
  EXPECT_EQ(numbers("/pair_correlation/partial/pairs:a:a"), (std::vector<double>{1.0, 0.0, 7.0}));
  EXPECT_EQ(numbers("/pair_correlation/partial/pairs:a:b"), (std::vector<double>{2.0, 0.0, 14.0}));
  EXPECT_EQ(numbers("/pair_correlation/partial/pairs:b:b"), (std::vector<double>{3.0, 0.0, 21.0}));
  EXPECT_EQ(numbers("/pair_correlation/partial/g:a:b").size(), 3U);
}

TEST_F(AnalysisFile, ErrorsAndTimesOfRowsAreTheirOwn) {
  const Scene scene = measured_scene("");
  AnalysisRecord record = made_by_hand(scene);
  record.density_rows[1].samples = 5;
  record.motion_rows[1].samples = 4;
  write(scene, record);
  EXPECT_NEAR(number("/displacement", "diffusion_error"), 0.0, 1e-12) << "of a straight line";
  EXPECT_EQ(number("/displacement", "diffusion_from"), 32.0) << "the second half of the samples";
  EXPECT_NEAR(number("/pressure", "standard_deviation"), 1.0, 1e-2) << "the deviation of 3 and 1";
  EXPECT_EQ(numbers("/density/rows/time"), (std::vector<double>{0.0, 32.0}));
  EXPECT_EQ(numbers("/profile/rows/time"), (std::vector<double>{0.0, 40.0}));
  EXPECT_EQ(numbers("/density/rows/samples"), (std::vector<double>{2.0, 5.0}));
  EXPECT_EQ(numbers("/profile/rows/samples"), (std::vector<double>{1.0, 4.0}));
  EXPECT_EQ(numbers("/profile/rows/disks"), (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
}

// A run that ended before its first sample writes a file, too.
TEST_F(AnalysisFile, WithoutSamplesItsListsAreEmpty) {
  const Scene scene = measured_scene("");
  write(scene, empty_record(scene));
  EXPECT_TRUE(numbers("/samples/time").empty());
  EXPECT_TRUE(numbers("/displacement/mean_square").empty());
  EXPECT_TRUE(numbers("/density/rows/number_density").empty());
  for (const AnalysisCurve& curve : read_analysis_curves(path_, 100)) EXPECT_FALSE(curve.in_time) << curve.name;
}

TEST_F(AnalysisFile, ItsCurvesAreReadBack) {
  write("");
  std::map<std::string, AnalysisCurve> curves;
  for (const AnalysisCurve& curve : read_analysis_curves(path_, samples)) curves[curve.name] = curve;
  const SampleSeries series = made_by_hand(measured_scene("")).series;
  EXPECT_EQ(curves.size(), 16U);
  EXPECT_EQ(curves["psi6, local"].y, series.local_order);
  EXPECT_EQ(curves["psi6, global"].y, series.global_order);
  EXPECT_EQ(curves["pressure of samples"].x, series.time);
  EXPECT_TRUE(curves["pressure of samples"].in_time);
  EXPECT_EQ(curves["S(kx)"].x, numbers("/structure_factor/kx"));
  EXPECT_EQ(curves["S(ky)"].x, numbers("/structure_factor/ky"));
  EXPECT_EQ(curves["S(ky)"].y, (std::vector<double>{3.0, 4.0}));
  EXPECT_FALSE(curves["S(ky)"].in_time);
  EXPECT_EQ(curves["g6(r)"].y, (std::vector<double>{0.75, 0.5}));
  EXPECT_EQ(curves["mean vy (position)"].y, (std::vector<double>{3.0, 4.0}));
}

// At most as many points as asked for, each with its own time.
TEST_F(AnalysisFile, OfLongCurvesEvenlyChosenPointsAreReadBack) {
  write("");
  for (const std::size_t most : {63U, 32U, 31U, 10U, 2U}) {
    for (const AnalysisCurve& curve : read_analysis_curves(path_, most)) {
      EXPECT_LE(curve.y.size(), most) << curve.name;
      EXPECT_EQ(curve.x.size(), curve.y.size()) << curve.name;
    }
  }
  const std::vector<AnalysisCurve> curves = read_analysis_curves(path_, 32);
  const auto of = [](const AnalysisCurve& curve) { return curve.name == "mean v(0) v(t), 1 point of 2"; };
  const auto found = std::find_if(curves.begin(), curves.end(), of);
  ASSERT_NE(found, curves.end());
  for (std::size_t k = 0; k < 32; ++k) EXPECT_EQ(found->y[k], 100.0 - found->x[k]);
  EXPECT_EQ(found->x.back(), 62.0);
}

// In a file whose curves have other lengths than their times, no curve may be shown with the wrong times.
TEST_F(AnalysisFile, CurvesOfOtherLengthsThanTheirTimesAreLeftOut) {
  const Scene scene = measured_scene("");
  const auto has_autocorrelation = [&] {
    const std::vector<AnalysisCurve> curves = read_analysis_curves(path_, 100);
    EXPECT_FALSE(curves.empty());
    return std::any_of(curves.begin(), curves.end(),
                       [](const AnalysisCurve& curve) { return curve.name.starts_with("mean v(0) v(t)"); });
  };
  AnalysisRecord record = made_by_hand(scene);
  write(scene, record);
  EXPECT_TRUE(has_autocorrelation());
  record.series.autocorrelation.pop_back();
  write(scene, record);
  EXPECT_FALSE(has_autocorrelation());
}

}  // namespace
}  // namespace carom
