// The page of panels with logarithmic axes: gnuplot's commands and data.
#include "io/plots/log_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/stand_in_gnuplot.hpp"

namespace carom {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

// A curve of two errors, one of which has a bar that reaches below zero, and of a bound; and a curve of bounds only.
LogPanel panel_with_bounds() {
  LogPanel panel;
  panel.title = "first";
  panel.x_label = "cost";
  panel.y_label = "error";
  panel.x_low = 1.0;
  panel.x_high = 1e3;
  panel.y_low = 1e-8;
  panel.y_high = 1e2;
  panel.curves.push_back({0, "one", {{1.0, 10.0, 2.0}, {10.0, 1.0, 5.0}, {100.0, 0.25, 0.0, true}}});
  panel.curves.push_back({1, "two", {{20.0, 3.0, 0.0, true}}, true});
  panel.remark = "remark";
  return panel;
}

LogPanel panel_of(const std::string& title) {
  LogPanel panel;
  panel.title = title;
  panel.x_low = panel.y_low = 0.5;
  panel.x_high = panel.y_high = 2e5;
  panel.curves.push_back({2, "left", {{2.0, 3.0, 1.0}}, false, true});
  return panel;
}

// Two columns; two rows of the first section, and one row, which is full, of the second.
LogFigure figure() {
  LogFigure f;
  f.title = "page";
  f.caption = "line one\nline two";
  f.columns = 2;
  f.sections.push_back({"upper", {panel_with_bounds(), panel_of("second"), panel_of("third")}});
  f.sections.push_back({"lower", {panel_of("fourth"), panel_of("fifth")}});
  return f;
}

// Draws the figure. The commands are those of the SVG only, since the PNG repeats them.
class LogFigureScript : public ::testing::Test {
 protected:
  LogFigureScript() {
    EXPECT_TRUE(draw_log_figure(figure(), gnuplot_.folder() + "/a.svg", gnuplot_.folder() + "/a.png"));
  }
  std::vector<std::string> commands(const std::string& begin) const {
    std::vector<std::string> all = gnuplot_.commands(begin);
    all.resize(all.size() / 2);
    return all;
  }

  test::StandInGnuplot gnuplot_;
};

constexpr double page_width = 2.0 * 262.0, page_height = 40.0 + 44.0 + 2.0 * 34.0 + 3.0 * 270.0;

TEST_F(LogFigureScript, APictureHasRoomForAllRows) {
  const std::vector<std::string> svg = gnuplot_.commands("set terminal svg size ");
  ASSERT_THAT(svg, SizeIs(1));
  EXPECT_THAT(svg[0], StartsWith("524,962 "));
  const std::vector<std::string> png = gnuplot_.commands("set terminal pngcairo size ");
  ASSERT_THAT(png, SizeIs(1));
  EXPECT_THAT(png[0], StartsWith("1048,1924 "));
}

TEST_F(LogFigureScript, ErrorsAndBoundsAreBlocksOfTheirOwn) {
  const auto blocks = gnuplot_.blocks();
  ASSERT_THAT(blocks, SizeIs(12));
  EXPECT_THAT(blocks[0], ElementsAre(ElementsAre(1.0, 10.0, 8.0, 12.0), ElementsAre(10.0, 1.0, 1e-9, 6.0)));
  EXPECT_THAT(blocks[1], ElementsAre(ElementsAre(100.0, 0.25, 0.25, 0.25)));
  ASSERT_THAT(blocks[2], ElementsAre(SizeIs(4))) << "a block with nothing to draw must still exist";
  EXPECT_TRUE(std::isnan(blocks[2][0][0]));
  EXPECT_THAT(blocks[3], ElementsAre(ElementsAre(20.0, 3.0, 3.0, 3.0)));
  EXPECT_THAT(blocks[8], ElementsAre(ElementsAre(2.0, 3.0, 2.0, 4.0)));
}

TEST_F(LogFigureScript, EachCurveIsDrawnFromItsOwnBlocks) {
  const std::vector<std::string> plots = commands("plot 'data' index ");
  ASSERT_THAT(plots, SizeIs(5));
  EXPECT_THAT(plots[0], AllOf(StartsWith("0 using 1:2 with lines lw 1.6 dt solid lc rgb '#D55E00'"),
                              HasSubstr(", 'data' index 0 using 1:2:3:4 with yerrorbars pt 5 "),
                              HasSubstr(", 'data' index 1 using 1:2 with points pt 4 "),
                              HasSubstr(", 'data' index 2 using 1:2 with lines lw 1 dt (6,4) lc rgb '#0072B2'"),
                              HasSubstr(", 'data' index 2 using 1:2:3:4 with yerrorbars pt 6 "),
                              HasSubstr(", 'data' index 3 using 1:2 with points pt 6 ")));
  EXPECT_THAT(plots[1], AllOf(StartsWith("4 using 1:2 with lines"), HasSubstr("index 5 using 1:2 with points pt 12 ")));
  EXPECT_THAT(plots[4], StartsWith("10 using 1:2 with lines"));
}

TEST_F(LogFigureScript, PanelsStandInRowsBelowTheirHeadings) {
  const std::vector<std::string> left = commands("set lmargin at screen "), top = commands("set tmargin at screen "),
                                 right = commands("set rmargin at screen "),
                                 bottom = commands("set bmargin at screen ");
  ASSERT_THAT(left, SizeIs(6)) << "the first one is for the whole page";
  const double columns[] = {0.0, 262.0, 0.0, 0.0, 262.0};
  constexpr double lower = 74.0 + 2.0 * 270.0 + 34.0;
  const double rows[] = {74.0, 74.0, 74.0 + 270.0, lower, lower};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(std::stod(left[k + 1]), (columns[k] + 58.0) / page_width, 1e-12) << k;
    EXPECT_NEAR(std::stod(right[k + 1]), (columns[k] + 252.0) / page_width, 1e-12) << k;
    EXPECT_NEAR(std::stod(top[k + 1]), 1.0 - (rows[k] + 68.0) / page_height, 1e-12) << k;
    EXPECT_NEAR(std::stod(bottom[k + 1]), 1.0 - (rows[k] + 226.0) / page_height, 1e-12) << k;
  }
  for (const auto& [words, down] : {std::pair("'upper'", 58.0), std::pair("'lower'", 58.0 + 34.0 + 540.0)}) {
    const std::vector<std::string> heading = commands(std::string("set label ") + words + " at screen 0.012, screen ");
    ASSERT_THAT(heading, SizeIs(1)) << words;
    EXPECT_NEAR(std::stod(heading[0]), 1.0 - down / page_height, 1e-12) << words;
  }
}

TEST_F(LogFigureScript, AxesGoByTheirPanel) {
  constexpr const char* small = "[0.5:200000]";
  EXPECT_THAT(commands("set xrange "), ElementsAre("[1:2]", "[1:1000]", small, small, small, small));
  EXPECT_THAT(commands("set yrange "), ElementsAre("[1:2]", "[1e-08:100]", small, small, small, small));
  EXPECT_THAT(commands("set xtics ")[0], "('10^{3}' 1e3, '10^{2}' 1e2, '10^{1}' 1e1, '10^{0}' 1e0)");
  // With ten decades every third has its number; with five and a half every second.
  EXPECT_THAT(commands("set ytics ")[0],
              "('10^{2}' 1e2, '' 1e1 1, '' 1e0 1, '10^{-1}' 1e-1, '' 1e-2 1, '' 1e-3 1, '10^{-4}' 1e-4, '' 1e-5 1, "
              "'' 1e-6 1, '10^{-7}' 1e-7, '' 1e-8 1)");
  EXPECT_THAT(commands("set xtics ")[1], "('10^{5}' 1e5, '' 1e4 1, '10^{3}' 1e3, '' 1e2 1, '10^{1}' 1e1, '' 1e0 1)");
  EXPECT_THAT(commands("set xlabel '")[0], StartsWith("cost'"));
  EXPECT_THAT(commands("set ylabel '")[0], StartsWith("error'"));
}

// The names of a panel's curves are one below the other at the right, with the remark below them.
TEST_F(LogFigureScript, NamesStandAboveThePanel) {
  const auto height = [&](const std::string& words) {
    const std::vector<std::string> found = commands("set label '" + words + "' at screen ");
    if (found.empty()) return -1.0;
    const std::size_t second = found[0].find("screen ");
    return (1.0 - std::stod(found[0].substr(second + 7))) * page_height;
  };
  EXPECT_NEAR(height("first"), 74.0 + 14.0, 1e-9);
  EXPECT_NEAR(height("one"), 74.0 + 31.0, 1e-9);
  EXPECT_NEAR(height("two"), 74.0 + 45.0, 1e-9);
  EXPECT_NEAR(height("remark"), 74.0 + 59.0, 1e-9);
  EXPECT_NEAR(height("left"), 74.0 + 31.0, 1e-9);
  EXPECT_NEAR(page_height - height("line one"), 30.0, 1e-9);
  EXPECT_NEAR(page_height - height("line two"), 14.0, 1e-9);
  EXPECT_THAT(commands("set label 'two' at ")[0], AllOf(HasSubstr(" right "), HasSubstr("'#0072B2'")));
  EXPECT_THAT(commands("set label 'left' at ")[0], AllOf(HasSubstr(" left "), Not(HasSubstr(" right "))));
}

}  // namespace
}  // namespace carom
