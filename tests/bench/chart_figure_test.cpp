// The pictures of the chart show the numbers of chart.csv, inside their panels.
#include "app/chart/chart_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/chart/chart_table.hpp"

namespace carom {
namespace {

using chart::ChartResult;

const ChartResult& tiny_chart() {
  static const ChartResult result = chart::measure_chart(chart::tiny_effort(), 2, [](double) {});
  return result;
}

struct Row {
  double cost = 0.0, error = 0.0, standard_error = 0.0;
};

std::vector<Row> rows_of(const std::string& csv) {
  std::vector<Row> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), 11) << line;
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 11) << line;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    cells.resize(12);
    rows.push_back({std::stod(cells[4]), std::stod(cells[6]), cells[7].empty() ? 0.0 : std::stod(cells[7])});
  }
  return rows;
}

bool same(double a, double b) {
  return std::abs(a - b) <= 2e-5 * std::abs(b);
}

// A point is an error in the table or, drawn open, a bound of one.
bool is_in(const std::vector<Row>& rows, const LogPoint& p, bool of_crowd) {
  constexpr double floor = 1e-17;
  return std::any_of(rows.begin(), rows.end(), [&](const Row& r) {
    if (of_crowd) return same(p.y, r.error);
    if (!same(p.x, r.cost)) return false;
    const double size = std::abs(r.error);
    return p.bound ? same(p.y, 2.0 * r.standard_error) || same(p.y, std::max(size, floor)) : same(p.y, size);
  });
}

TEST(ChartFigure, EveryNumberDrawnIsInTheTableAndInItsPanel) {
  const std::vector<Row> rows = rows_of(chart::csv_of(tiny_chart()));
  std::size_t points = 0;
  for (const LogFigure& figure : {main_figure(tiny_chart()), whole_figure(tiny_chart())}) {
    for (const LogSection& section : figure.sections) {
      for (const LogPanel& panel : section.panels) {
        const bool of_crowd = panel.title.find("frames per dt") != std::string::npos;
        for (const LogCurve& curve : panel.curves) {
          for (const LogPoint& p : curve.points) {
            ++points;
            EXPECT_TRUE(is_in(rows, p, of_crowd)) << panel.title << ": " << p.x << ", " << p.y;
            EXPECT_TRUE(panel.x_low <= p.x && p.x <= panel.x_high) << panel.title << ": " << p.x;
            EXPECT_TRUE(panel.y_low <= p.y && p.y <= panel.y_high) << panel.title << ": " << p.y;
          }
        }
      }
    }
  }
  EXPECT_GT(points, 300U);
}

TEST(ChartFigure, EverySceneAndErrorHasAPanel) {
  const LogFigure whole = whole_figure(tiny_chart());
  EXPECT_EQ(whole.sections.size(), 10U);
  for (const LogSection& section : whole.sections) EXPECT_EQ(section.panels.size(), 6U) << section.heading;
  EXPECT_EQ(main_figure(tiny_chart()).sections.at(0).panels.size(), 11U) << "ten scenes and rollback's stall";
}

}  // namespace
}  // namespace carom
