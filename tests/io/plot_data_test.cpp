// gnuplot's commands and data: each line's own numbers, axes that contain them, and names at the ends of lines.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/plots/gnuplot.hpp"
#include "io/plots/plot.hpp"
#include "tests/support/stand_in_gnuplot.hpp"

namespace carom {
namespace {

using test::StandInGnuplot;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Block = StandInGnuplot::Block;

// The two numbers of each "set yrange [a:b]", or of another range.
std::vector<std::pair<double, double>> ranges(const StandInGnuplot& gnuplot, const std::string& axis) {
  std::vector<std::pair<double, double>> all;
  for (const std::string& text : gnuplot.commands("set " + axis + "range [")) {
    all.emplace_back(std::stod(text), std::stod(text.substr(text.find(':') + 1)));
  }
  return all;
}

// The vertical range for one panel.
std::pair<double, double> heights_of(const Panel& panel, bool logarithmic = false) {
  const StandInGnuplot gnuplot;
  EXPECT_TRUE(draw_svg({"", "t", 1.0, {panel}, logarithmic}, gnuplot.picture()));
  return ranges(gnuplot, "y").at(0);
}

TEST(PlotData, EveryLineAndBandHasABlockOfItsOwn) {
  const StandInGnuplot gnuplot;
  const Band band{{0.0, 1.0}, {1.0, 2.0}, {3.0, 4.0}, "#123456"};
  const Panel first{.y_label = "a",
                    .lines = {{"one", {0.0, 1.0}, {5.0, 6.0}}, {"none", {}, {}}, {"two", {0.0, 1.0}, {7.0, 8.0}}},
                    .bands = {{{}, {}, {}, "#000000"}, band}};
  const Panel second{.y_label = "b", .lines = {{"three", {0.0, 1.0}, {9.0, 10.0}}}, .bands = {band}};
  ASSERT_TRUE(draw_svg({"", "t", 1.0, {first, second}}, gnuplot.picture()));
  const std::vector<Block> blocks = gnuplot.blocks();
  ASSERT_EQ(blocks.size(), 7U);
  const Block drawn_band{{0.0, 1.0, 3.0}, {1.0, 2.0, 4.0}};
  EXPECT_EQ(blocks[1], drawn_band);
  EXPECT_EQ(blocks[2], (Block{{0.0, 5.0}, {1.0, 6.0}}));
  EXPECT_EQ(blocks[4], (Block{{0.0, 7.0}, {1.0, 8.0}}));
  EXPECT_EQ(blocks[5], drawn_band);
  EXPECT_EQ(blocks[6], (Block{{0.0, 9.0}, {1.0, 10.0}}));
  const std::vector<std::string> plots = gnuplot.commands("plot ");
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_THAT(plots[0], ::testing::StartsWith("'data' index 1 using 1:2:3 with filledcurves lc rgb '#123456', "
                                              "'data' index 2 with lines"));
  EXPECT_THAT(plots[0], HasSubstr(", 'data' index 4 with lines"));
  EXPECT_THAT(plots[1], ::testing::StartsWith("'data' index 5 using"));
  EXPECT_THAT(plots[1], HasSubstr(", 'data' index 6 with lines"));
  EXPECT_THAT(gnuplot.commands("set ylabel "), ElementsAre("'a'", "'b'"));
  EXPECT_GT(gnuplot.script().find("set xlabel 't'"), gnuplot.script().find("plot '")) << "only the lowest panel has it";
}

TEST(PlotData, LinesOfOnePanelHaveColoursOfTheirOwn) {
  const StandInGnuplot gnuplot;
  const std::vector<double> t{0.0, 1.0};
  ASSERT_TRUE(draw_svg({"", "t", 1.0, {{.y_label = "a", .lines = {{"one", t, t}, {"two", t, t}}}}}, gnuplot.picture()));
  const std::string plot = gnuplot.commands("plot ").at(0);
  const std::size_t first = plot.find("rgb '"), second = plot.find("rgb '", first + 1);
  ASSERT_NE(second, std::string::npos);
  EXPECT_NE(plot.substr(first, 12), plot.substr(second, 12));
}

// A long line, or band, is thinned without losing spikes.
TEST(PlotData, ThinnedLinesKeepTheirExtremes) {
  const StandInGnuplot gnuplot;
  Line line{"line", {}, {}};
  Band band{{}, {}, {}, "#123456"};
  for (int k = 0; k < 100'000; ++k) {
    line.x.push_back(k);
    line.y.push_back(k == 54'321 ? 9.0 : k == 54'322 ? -9.0 : 0.001 * (k % 7));
    band.x.push_back(k);
    band.low.push_back(k == 23'456 ? -5.0 : -1.0);
    band.high.push_back(k == 65'432 ? 5.0 : 1.0);
  }
  ASSERT_TRUE(draw_svg({"", "t", 1e5, {{.y_label = "a", .lines = {line}, .bands = {band}}}}, gnuplot.picture()));
  const std::vector<Block> blocks = gnuplot.blocks();
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_LE(blocks[0].size(), 4000U);
  EXPECT_LE(blocks[1].size(), 4002U);
  double low = 0.0, high = 0.0;
  for (const std::vector<double>& row : blocks[0]) low = std::min(low, row[1]), high = std::max(high, row[2]);
  EXPECT_EQ(low, -5.0);
  EXPECT_EQ(high, 5.0);
  bool up = false, down = false;
  for (std::size_t k = 0; k < blocks[1].size(); ++k) {
    up = up || blocks[1][k] == std::vector<double>{54'321.0, 9.0};
    down = down || blocks[1][k] == std::vector<double>{54'322.0, -9.0};
    EXPECT_TRUE(k == 0 || blocks[1][k][0] > blocks[1][k - 1][0]) << "from left to right";
  }
  EXPECT_TRUE(up && down);
}

TEST(PlotData, AxesHoldAllValues) {
  const auto panel = [](std::vector<double> y, bool from_zero = false) {
    return Panel{.y_label = "a",
                 .lines = {{"one", {0.0, 1.0}, {y[0], y[1]}}, {"two", {0.0, 1.0}, {y[2], y[3]}}},
                 .from_zero = from_zero};
  };
  const auto near = [](double low, double high) {
    return ::testing::Pair(::testing::DoubleNear(low, 1e-9), ::testing::DoubleNear(high, 1e-9));
  };
  EXPECT_THAT(heights_of(panel({3.0, 5.0, 2.0, 4.0})), near(2.0 - 0.18, 5.0 + 0.18));
  EXPECT_THAT(heights_of(panel({3.0, 5.0, 2.0, 4.0}, true)), near(0.0, 5.3));
  EXPECT_THAT(heights_of(panel({-3.0, -5.0, -2.0, -4.0}, true)), near(-5.3, 0.3));
  EXPECT_THAT(heights_of(panel({2.0, 2.0, 2.0, 2.0})), near(1.8 - 0.024, 2.2 + 0.024));
  EXPECT_THAT(heights_of(panel({0.0, 0.0, 0.0, 0.0})), near(-1.12, 1.12));
  EXPECT_THAT(heights_of(panel({1.0, 100.0, 10.0, 10.0}), true), near(std::pow(10.0, -0.12), std::pow(10.0, 2.12)));
}

// The axis starts at 0, or, if both axes are logarithmic, at the first point of all lines.
TEST(PlotData, TheHorizontalAxisBeginsWithTheData) {
  const Panel panel{.y_label = "a", .lines = {{"one", {0.5, 8.0}, {1.0, 2.0}}, {"two", {0.25, 8.0}, {1.0, 2.0}}}};
  for (const bool logarithmic : {false, true}) {
    const StandInGnuplot gnuplot;
    ASSERT_TRUE(draw_svg({"", "t", 8.0, {panel}, logarithmic}, gnuplot.picture()));
    EXPECT_EQ(ranges(gnuplot, "x").at(0), std::pair(logarithmic ? 0.25 : 0.0, 8.0));
    EXPECT_EQ(gnuplot.commands("set logscale").size(), logarithmic ? 1U : 0U);
  }
}

struct Name {
  std::string text;
  double height = 0.0;
};

// The names in the margin.
std::vector<Name> names_of(const StandInGnuplot& gnuplot) {
  std::vector<Name> names;
  for (const std::string& text : gnuplot.commands("set label ")) {
    const std::size_t at = text.find(" at graph 1.035, first ");
    if (at == std::string::npos) continue;
    const std::size_t begin = text.find('\'') + 1;
    names.push_back({text.substr(begin, text.find('\'', begin) - begin), std::stod(text.substr(at + 23))});
  }
  return names;
}

// Names are at the ends of the lines, moved apart if these are too close.
TEST(PlotData, NamesStandWhereLinesEnd) {
  for (const bool logarithmic : {false, true}) {
    const StandInGnuplot gnuplot;
    const std::vector<double> t{0.5, 1.0};
    const Panel panel{.y_label = "a",
                      .lines = {{"high", t, {1.0, 1000.0}}, {"low", t, {1.0, 2.0}}, {"lower", t, {1.0, 1.99}}}};
    ASSERT_TRUE(draw_svg({"", "t", 1.0, {panel}, logarithmic}, gnuplot.picture()));
    const std::vector<Name> names = names_of(gnuplot);
    ASSERT_EQ(names.size(), 3U);
    EXPECT_EQ(names[0].text, "high");
    EXPECT_NEAR(names[0].height, 1000.0, 1e-6);
    const auto shown = [&](double y) { return logarithmic ? std::log10(y) : y; };
    const auto [low, high] = ranges(gnuplot, "y").at(0);
    const double letters = 19.0 / (0.9 * 310.0) * (shown(high) - shown(low));
    EXPECT_NEAR(shown(names[1].height) - shown(names[2].height), letters, 0.01 * letters);
  }
}

TEST(PlotData, ALineThatReachesTheMarginIsNotGone) {
  const StandInGnuplot gnuplot;
  const Panel panel{.y_label = "a", .lines = {{"all", {0.0, 1.0}, {1.0, 2.0}}, {"part", {0.0, 0.5}, {1.0, 5.0}}}};
  ASSERT_TRUE(draw_svg({"", "t", 1.0, {panel}}, gnuplot.picture()));
  const std::vector<Name> names = names_of(gnuplot);
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[0].text, "all");
  EXPECT_EQ(names[1].text, "part, gone");
  EXPECT_EQ(gnuplot.commands("set arrow ").size(), 1U);
  EXPECT_THAT(gnuplot.script(), HasSubstr("set label 1002 '' at first 0.5, first 5 point"));
}

// The name of a guide is inside the panel: left of its end, or above its start if it ends at the margin.
TEST(PlotData, GuidesAreNamedWithinThePanel) {
  const StandInGnuplot gnuplot;
  const Panel panel{.y_label = "a",
                    .lines = {{"data", {0.5, 8.0}, {1.0, 2.0}},
                              {"short", {0.5, 2.0}, {1.0, 3.0}, LineStyle::guide},
                              {"whole", {1.0, 8.0}, {1.5, 4.0}, LineStyle::guide}}};
  ASSERT_TRUE(draw_svg({"", "t", 8.0, {panel}, true}, gnuplot.picture()));
  EXPECT_THAT(gnuplot.script(), HasSubstr("'short' at first 2, first 3 right"));
  EXPECT_THAT(gnuplot.script(), HasSubstr("'whole' at first 1, first 1.5 left"));
}

TEST(PlotData, EnergiesAreTheirOwnLines) {
  const StandInGnuplot gnuplot;
  ASSERT_TRUE(plot_energy(gnuplot.picture(), "", {{0.0, 1.0}, {2.0, 1.5}, {1.0, 1.25}, {3.5, 3.5}}));
  const std::vector<Block> blocks = gnuplot.blocks();
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0], (Block{{0.0, 3.5}, {1.0, 3.5}}));
  EXPECT_EQ(blocks[1], (Block{{0.0, 2.0}, {1.0, 1.5}}));
  EXPECT_EQ(blocks[2], (Block{{0.0, 1.0}, {1.0, 1.25}}));
  EXPECT_EQ(blocks[3], (Block{{0.0, 0.5}, {1.0, 0.75}}));
  const std::vector<Name> names = names_of(gnuplot);
  ASSERT_EQ(names.size(), 4U);
  EXPECT_EQ(names[0].text, "total");
  EXPECT_EQ(names[1].text, "kinetic");
  EXPECT_EQ(names[2].text, "potential");
  EXPECT_EQ(names[3].text, "rotational");
  EXPECT_EQ(ranges(gnuplot, "x").at(0), std::pair(0.0, 1.0));
}

Disks disks_of_speeds(DiskId count, double factor) {
  Disks d;
  for (DiskId id = 0; id < count; ++id) append(d, {0.0, 0.0, factor * id, -2.0 * factor * id, 1.0, 1.0, id});
  return d;
}

// Ten disks are drawn as lines, eleven as bands: from the 5 % to the 95 % quantile, and so on inwards.
TEST(PlotData, VelocitiesAreThoseOfTheirComponent) {
  VelocityRecord ten, eleven;
  for (const double t : {0.0, 1.0}) {
    record(ten, disks_of_speeds(10, 1.0 + t), t);
    record(eleven, disks_of_speeds(11, 1.0 + t), t);
  }
  record(eleven, disks_of_speeds(1, 1.0), 2.0);
  const StandInGnuplot gnuplot;
  ASSERT_TRUE(plot_velocity(gnuplot.picture(), "", ten));
  std::vector<Block> blocks = gnuplot.blocks();
  ASSERT_EQ(blocks.size(), 20U);
  EXPECT_EQ(blocks[3], (Block{{0.0, 3.0}, {1.0, 6.0}}));
  EXPECT_EQ(blocks[13], (Block{{0.0, -6.0}, {1.0, -12.0}}));
  ASSERT_TRUE(plot_velocity(gnuplot.picture(), "", eleven));
  blocks = gnuplot.blocks();
  ASSERT_EQ(blocks.size(), 20U) << "three bands and seven edges each";
  EXPECT_EQ(blocks[0], (Block{{0.0, 0.0, 10.0}, {1.0, 0.0, 20.0}, {2.0, 0.0, 0.0}}));
  EXPECT_EQ(blocks[1], (Block{{0.0, 1.0, 10.0}, {1.0, 2.0, 20.0}, {2.0, 0.0, 0.0}})) << "5 % and 95 % of 11";
  EXPECT_EQ(blocks[2], (Block{{0.0, 3.0, 8.0}, {1.0, 6.0, 16.0}, {2.0, 0.0, 0.0}}));
  EXPECT_EQ(blocks[3], (Block{{0.0, 5.0}, {1.0, 10.0}, {2.0, 0.0}})) << "the median";
  EXPECT_EQ(blocks[10], (Block{{0.0, -20.0, 0.0}, {1.0, -40.0, 0.0}, {2.0, 0.0, 0.0}}));
  EXPECT_EQ(blocks[13], (Block{{0.0, -10.0}, {1.0, -20.0}, {2.0, 0.0}}));
}

}  // namespace
}  // namespace carom
