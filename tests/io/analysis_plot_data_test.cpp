// The plots of [analysis] show the quantities measured, each with its own numbers, and what they are compared with.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "io/plots/analysis_plots.hpp"
#include "tests/support/stand_in_gnuplot.hpp"

namespace carom {
namespace {

using test::StandInGnuplot;
using testing::HasSubstr;
using Block = StandInGnuplot::Block;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// A box of 10 by 20, periodic along both axes, until time 4.
Scene scene_with(const std::string& quantity, const std::string& more = "") {
  return parse_scene(fmt::format("[box]\nwidth = 10.0\nheight = 20.0\nleft = \"periodic\"\nright = \"periodic\"\n"
                                 "bottom = \"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = 10\n"
                                 "positions = \"random\"\nradius = 0.1\nmass = 1.0\n[run]\nmethod = \"exact\"\n"
                                 "t_end = 4.0\n[analysis]\nwhat = [\"{}\"]\n{}\n",
                                 quantity, more),
                     "scene", "");
}

// The data drawn for one quantity.
struct Drawn {
  std::string script;
  std::vector<Block> blocks;
};

Drawn drawn(const Scene& scene, const std::function<void(AnalysisRecord&)>& fill) {
  const StandInGnuplot gnuplot;
  AnalysisRecord record = empty_record(scene);
  fill(record);
  EXPECT_TRUE(draw_analysis(gnuplot.folder(), scene, record));
  return {gnuplot.script(), gnuplot.blocks()};
}

TEST(AnalysisPlotData, PressureAndRateHaveTheirSamplesAndTheirMean) {
  const auto fill = [](AnalysisRecord& record) {
    record.series.time = {0.0, 1.0, 4.0};
    record.series.interval = {0.0, 1.0, 3.0};
    record.series.pressure = {no_number, 2.0, 6.0};
    record.series.collision_rate = {no_number, 1.0, 9.0};
  };
  const Drawn pressure = drawn(scene_with("pressure"), fill), rate = drawn(scene_with("collision_rate"), fill);
  ASSERT_EQ(pressure.blocks.size(), 2U);
  EXPECT_EQ(pressure.blocks[0], (Block{{1.0, 2.0}, {4.0, 6.0}}));
  EXPECT_EQ(pressure.blocks[1], (Block{{1.0, 5.0}, {4.0, 5.0}})) << "weighted by time";
  EXPECT_EQ(rate.blocks.at(0), (Block{{1.0, 1.0}, {4.0, 9.0}}));
  EXPECT_EQ(rate.blocks.at(1), (Block{{1.0, 7.0}, {4.0, 7.0}}));
  EXPECT_THAT(pressure.script, HasSubstr("set ylabel 'pressure'"));
  EXPECT_THAT(rate.script, HasSubstr("set ylabel 'collisions per disk and unit time'"));
}

// Pressure and collision rate are those of all disks, whatever group is selected.
TEST(AnalysisPlotData, TheTitleNamesTheGroupThatIsMeasured) {
  const std::vector<std::pair<std::string, std::string>> subjects{
      {"pair_correlation", "pair correlation of A"},
      {"displacement", "displacement of A"},
      {"speeds", "speeds of A"},
      {"density", "density profile of A"},
      {"pressure", "pressure"},
      {"collision_rate", "collision rate"},
      {"profile", "velocity and temperature of A"},
      {"velocity_autocorrelation", "velocity autocorrelation of A"},
      {"structure_factor", "structure factor of A"},
      {"bond_order", "bond order of A"},
      {"bond_correlation", "bond correlation of A"},
      {"bond_autocorrelation", "bond autocorrelation of A"}};
  for (const auto& [quantity, subject] : subjects) {
    Scene scene = scene_with(quantity);
    scene.title = "gas";
    const auto nothing = [](AnalysisRecord&) {};
    EXPECT_THAT(drawn(scene, nothing).script, Not(HasSubstr(" of A'")));
    scene.analysis.group = "A";
    EXPECT_THAT(drawn(scene, nothing).script, HasSubstr(fmt::format("title 'gas: {}'", subject)));
  }
}

TEST(AnalysisPlotData, OrderAndMemoryAreSeries) {
  const auto fill = [](AnalysisRecord& record) {
    record.series.time = {1.0, 2.0, 4.0};
    record.series.local_order = {0.5, 0.6, 0.7};
    record.series.global_order = {0.1, 0.2, 0.3};
    record.series.autocorrelation = {1.0, 0.5, 0.25};
    record.series.bond_autocorrelation = {0.9, 0.8, 0.7};
  };
  const Drawn order = drawn(scene_with("bond_order"), fill);
  ASSERT_EQ(order.blocks.size(), 2U);
  EXPECT_EQ(order.blocks[0], (Block{{1.0, 0.5}, {2.0, 0.6}, {4.0, 0.7}}));
  EXPECT_EQ(order.blocks[1], (Block{{1.0, 0.1}, {2.0, 0.2}, {4.0, 0.3}}));
  const Drawn memory = drawn(scene_with("velocity_autocorrelation"), fill);
  EXPECT_EQ(memory.blocks.at(0), (Block{{0.0, 1.0}, {1.0, 0.5}, {3.0, 0.25}})) << "times since the first sample";
  EXPECT_THAT(memory.script, HasSubstr("set xrange [0:3]"));
  EXPECT_EQ(drawn(scene_with("bond_autocorrelation"), fill).blocks.at(0), (Block{{0.0, 0.9}, {1.0, 0.8}, {3.0, 0.7}}));
}

// 2 t^2 up to 4, then 8 t: the guides for t^2 and t go through the first and the last point.
TEST(AnalysisPlotData, GuidesOfTheDisplacementGoThroughItsEnds) {
  const Drawn all = drawn(scene_with("displacement"), [](AnalysisRecord& record) {
    record.series.time = {1.0, 2.0, 5.0, 17.0};
    record.series.displacement = {0.0, 2.0, 32.0, 128.0};
  });
  ASSERT_EQ(all.blocks.size(), 3U);
  EXPECT_EQ(all.blocks[0], (Block{{1.0, 2.0}, {4.0, 32.0}, {16.0, 128.0}}));
  ASSERT_EQ(all.blocks[1].size(), 2U);
  EXPECT_NEAR(all.blocks[1][0][1], 2.0, 1e-12);
  EXPECT_NEAR(all.blocks[1][1][0], 8.0, 1e-12) << "the guide ends as high as the curve";
  EXPECT_NEAR(all.blocks[1][1][1], 128.0, 1e-9);
  ASSERT_EQ(all.blocks[2].size(), 2U);
  EXPECT_NEAR(all.blocks[2][0][0], 1.0, 1e-12) << "the guide goes no further than the curve";
  EXPECT_NEAR(all.blocks[2][0][1], 8.0, 1e-12);
  EXPECT_NEAR(all.blocks[2][1][0], 16.0, 1e-12);
  EXPECT_NEAR(all.blocks[2][1][1], 128.0, 1e-9);
}

// A logarithmic axis has no zero: until the first kick or collision no disk has moved.
TEST(AnalysisPlotData, DisksAtRestHaveNoPointOfTheDisplacement) {
  const Drawn all = drawn(scene_with("displacement"), [](AnalysisRecord& record) {
    record.series.time = {1.0, 2.0, 5.0, 17.0};
    record.series.displacement = {0.0, 0.0, 32.0, 128.0};
  });
  EXPECT_EQ(all.blocks.at(0), (Block{{4.0, 32.0}, {16.0, 128.0}}));
}

TEST(AnalysisPlotData, ProfilesSayAlongWhichAxis) {
  for (const auto& [axis, length] : {std::pair{"x", 10.0}, std::pair{"y", 20.0}}) {
    const Scene density = scene_with("density", fmt::format("density = {{ axis = \"{}\", bins = 4 }}", axis));
    const Drawn all = drawn(density, [&](AnalysisRecord& record) {
      record.density.covered = {5.0, 10.0, 15.0, 20.0};  // each of four slabs of area 50
      record.density.samples = 1;
    });
    ASSERT_EQ(all.blocks.size(), 2U);
    const double bin = length / 4.0;
    EXPECT_EQ(all.blocks[0], (Block{{0.5 * bin, 0.1}, {1.5 * bin, 0.2}, {2.5 * bin, 0.3}, {3.5 * bin, 0.4}}));
    EXPECT_NEAR(all.blocks[1].at(0).at(1), 0.25, 1e-12);
    EXPECT_NEAR(all.blocks[1].at(1).at(1), 0.25, 1e-12);
    EXPECT_EQ(all.blocks[1].at(1).at(0), 3.5 * bin);
    EXPECT_THAT(all.script, HasSubstr(fmt::format("set xlabel 'position {}'", axis)));
    const Scene profile = scene_with("profile", fmt::format("profile = {{ axis = \"{}\", bins = 4 }}", axis));
    const Drawn motion = drawn(profile, [&](AnalysisRecord& record) {
      record.motion.samples = 1;
      for (std::size_t k = 0; k < 4; ++k) {
        record.motion.disks[k] = 1;
        record.motion.mass[k] = 2.0;
        record.motion.px[k] = 4.0 * static_cast<double>(k);
        record.motion.py[k] = -2.0;
      }
    });
    ASSERT_EQ(motion.blocks.size(), 3U);
    EXPECT_EQ(motion.blocks[0].at(3), (std::vector<double>{3.5 * bin, 6.0}));
    EXPECT_EQ(motion.blocks[1].at(3), (std::vector<double>{3.5 * bin, -1.0}));
    EXPECT_THAT(motion.script, HasSubstr(fmt::format("set xlabel 'position {}'", axis)));
  }
}

TEST(AnalysisPlotData, SpeedsAreComparedWithMaxwell) {
  const Scene scene = scene_with("speeds", "speeds = { bins = 10, max = 10.0 }");
  const Drawn all = drawn(scene, [](AnalysisRecord& record) {
    record.speeds.counts = {1, 3, 4, 2, 0, 0, 0, 0, 0, 0};
    record.speeds.samples = 1;
    record.speeds.largest_seen = 3.2;
  });
  ASSERT_EQ(all.blocks.size(), 2U);
  EXPECT_EQ(all.blocks[0], (Block{{0.5, 0.1}, {1.5, 0.3}, {2.5, 0.4}}));
  ASSERT_EQ(all.blocks[1].size(), 3U) << "the axis ends where there is nothing more to see";
  EXPECT_NEAR(all.blocks[1][0][1], 1.0 - std::exp(-0.5), 1e-12);
  const Drawn slow = drawn(scene, [](AnalysisRecord& record) {
    record.speeds.counts = {10, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    record.speeds.samples = 1;
    record.speeds.largest_seen = 0.9;
  });
  EXPECT_EQ(slow.blocks.at(1).size(), 3U) << "the axis goes to 3 at least";
}

TEST(AnalysisPlotData, StructureIsThatAlongItsAxis) {
  const Drawn all =
      drawn(scene_with("structure_factor", "structure_factor = { wave_numbers = 2 }"), [](AnalysisRecord& record) {
        record.structure.along_x = {2.0, 4.0};
        record.structure.along_y = {6.0, 8.0};
        record.structure.samples = 2;
      });
  ASSERT_EQ(all.blocks.size(), 3U);
  ASSERT_EQ(all.blocks[0].size(), 2U);
  ASSERT_EQ(all.blocks[1].size(), 2U);
  EXPECT_NEAR(all.blocks[0][1][0], 2.0 * 2.0 * M_PI / 10.0, 1e-9);
  EXPECT_EQ(all.blocks[0][1][1], 2.0);
  EXPECT_NEAR(all.blocks[1][1][0], 2.0 * 2.0 * M_PI / 20.0, 1e-9);
  EXPECT_EQ(all.blocks[1][1][1], 4.0);
  EXPECT_EQ(all.blocks[2].at(0).at(1), 1.0);
  EXPECT_EQ(all.blocks[2].at(1).at(1), 1.0);
}

// For all disks, for the pairs of groups, and the value of disks placed at random.
TEST(AnalysisPlotData, PairCorrelationsAreThoseOfTheirGroups) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 10.0\nheight = 20.0\n[[disks]]\nname = \"a\"\ncount = 5\npositions = \"random\"\nradius = 0.1\n"
      "mass = 1.0\n[[disks]]\nname = \"b\"\ncount = 5\npositions = \"random\"\nradius = 0.1\nmass = 1.0\n[run]\n"
      "method = \"exact\"\nt_end = 1.0\n[analysis]\nwhat = [\"pair_correlation\"]\n"
      "pair_correlation = { bins = 2, r_max = 2.0, groups = [\"a\", \"b\"] }\n",
      "scene", "");
  const Drawn all = drawn(scene, [](AnalysisRecord& record) {
    const double inner = M_PI, outer = 3.0 * M_PI;  // areas of the two rings
    ASSERT_EQ(record.partial.size(), 3U);
    const auto set = [&](PairRecord& pairs, Count times) {
      pairs.counts = {100 * times, 300 * times};
      pairs.expected = 100.0 / inner;
      EXPECT_NEAR(outer / inner, 3.0, 1e-12);
    };
    set(record.pairs, 1);
    for (std::size_t k = 0; k < 3; ++k) set(record.partial[k], 2 + k);
  });
  ASSERT_EQ(all.blocks.size(), 5U);
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_EQ(all.blocks[k].size(), 2U);
    EXPECT_EQ(all.blocks[k][0][0], 0.5);
    EXPECT_NEAR(all.blocks[k][0][1], all.blocks[k][1][1], 1e-9) << k;
  }
  EXPECT_NEAR(all.blocks[0][0][1], 1.0, 1e-9);
  EXPECT_NEAR(all.blocks[1][0][1], 2.0, 1e-9);
  EXPECT_NEAR(all.blocks[3][0][1], 4.0, 1e-9);
  EXPECT_EQ(all.blocks[4].at(0).at(1), 1.0);
  for (const char* const name : {"'all disks'", "'a, a'", "'a, b'", "'b, b'", "'random'"}) {
    EXPECT_THAT(all.script, HasSubstr(name));
  }
}

}  // namespace
}  // namespace carom
