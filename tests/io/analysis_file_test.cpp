// The numbers and attributes of analysis.h5, of a record made by hand.
#include "io/tables/analysis_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/blocking_error.hpp"
#include "core/load/scene_file.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

constexpr int samples = 64;

// 64 samples, a time unit apart, and two rows of each profile. more: keys of the box.
Scene measured_scene(const std::string& more) {
  return parse_scene(
      "[box]\nwidth = 8.0\nheight = 4.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\n" +
          more +
          "[[disks]]\ncount = 10\npositions = \"random\"\nradius = 0.1\nmass = 1.0\n"
          "[run]\nmethod = \"exact\"\nt_end = 63.0\n[analysis]\nwhat = [\"pair_correlation\", \"displacement\", "
          "\"speeds\", \"density\", \"pressure\", \"collision_rate\", \"profile\", \"bond_order\"]\nevery = 1.0\n"
          "density = { bins = 2, every = 32.0 }\nprofile = { bins = 2, every = 32.0, axis = \"x\" }\n",
      "scene", "");
}

// Two that are alike after two that are not: half as many samples as there seem to be.
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
  }
  record.displacement.doubtful = 5;
  record.pairs.centres = 7 * samples;
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
    const std::string path = (folder_.path() / "analysis.h5").string();
    write_analysis(path, scene, made_by_hand(scene));
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
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

 private:
  test::TestFolder folder_{"analysis_file"};
  hid_t file_ = -1;
};

TEST_F(AnalysisFile, SeriesHaveTheirMeansAndErrors) {
  write("");
  const SampleSeries series = made_by_hand(measured_scene("")).series;
  EXPECT_EQ(numbers("/samples/disks"), series.disks);
  EXPECT_EQ(numbers("/displacement/disks"), series.followed) << "those that are still there";
  EXPECT_EQ(number("/displacement", "doubtful"), 5.0);
  EXPECT_DOUBLE_EQ(number("/displacement", "diffusion"), 3.0 / 4.0) << "4 D t in two dimensions";
  // The mean of the first 3, for twice as long as the others.
  EXPECT_DOUBLE_EQ(number("/pressure", "mean"), (2.0 * samples + 3.0) / (samples + 1.0));
  // By blocking, where samples are correlated: sqrt(2) of what it were if they were not.
  EXPECT_DOUBLE_EQ(number("/pressure", "standard_error"), blocking_error(series.pressure));
  EXPECT_NEAR(number("/pressure", "standard_error"), 1.0 / std::sqrt(31.0), 1e-12);
  EXPECT_NEAR(number("/bond_order", "local_standard_error"), 0.1 / std::sqrt(31.0), 1e-12);
  EXPECT_DOUBLE_EQ(number("/bond_order", "global_mean"), 0.02);
}

TEST_F(AnalysisFile, CountsAreOverTheSamples) {
  write("");
  EXPECT_EQ(number("/pair_correlation", "centres"), 7.0) << "in the mean";
  EXPECT_EQ(number("/speeds", "beyond"), 6.0);
  EXPECT_EQ(number("/speeds", "temperature"), 1.5);
  EXPECT_EQ(word("/density", "axis"), "y");
  EXPECT_EQ(word("/profile", "axis"), "x");
}

TEST_F(AnalysisFile, RowsOfProfilesStandOneAfterTheOther) {
  write("");
  // Slabs of 8 x 2, two samples a row.
  EXPECT_EQ(numbers("/density/rows/number_density"), (std::vector<double>{0.125, 0.0625, 0.125, 0.0625}));
  EXPECT_EQ(numbers("/density/rows/packing_fraction"), (std::vector<double>{0.03125, 0.015625, 0.03125, 0.015625}));
  EXPECT_EQ(numbers("/profile/rows/velocity_x"), (std::vector<double>{1.0, 2.0, 1.0, 2.0}));
  EXPECT_EQ(numbers("/profile/rows/velocity_y"), (std::vector<double>{3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(numbers("/profile/position"), (std::vector<double>{2.0, 6.0}));
}

// Displacements across a shear flow are along y alone: 2 D t.
TEST_F(AnalysisFile, DiffusionAcrossAShearFlowIsThatOfOneDimension) {
  write("shear_rate = 0.1\n");
  EXPECT_DOUBLE_EQ(number("/displacement", "diffusion"), 3.0 / 2.0);
}

}  // namespace
}  // namespace carom
