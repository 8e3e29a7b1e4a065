// The order of convergence: exact power laws give their order, and noise and rounding are left out of the fit.
#include "app/chart/chart_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/chart/chart_result.hpp"
#include "app/chart/chart_table.hpp"

namespace carom::chart {
namespace {

std::vector<FitPoint> law(double coefficient, double order, double noise) {
  std::vector<FitPoint> points;
  for (double dt = 0.1; dt > 1e-4; dt *= 0.5) points.push_back({dt, coefficient * std::pow(dt, order), noise});
  return points;
}

TEST(ChartFit, PowerLawsGiveTheirOrder) {
  for (const double order : {0.5, 1.0, 2.0}) {
    const auto fit = fit_order(law(0.3, order, 0.0));
    ASSERT_TRUE(fit.has_value());
    EXPECT_NEAR(fit->order, order, 1e-12);
    EXPECT_NEAR(fit->coefficient, 0.3, 1e-12);
    EXPECT_NEAR(fit->order_error, 0.0, 1e-6);
  }
}

TEST(ChartFit, ASignDoesNotMatterAndScatterShows) {
  std::vector<FitPoint> points = law(-0.3, 1.0, 0.0);
  EXPECT_NEAR(fit_order(points)->order, 1.0, 1e-12);
  for (std::size_t k = 0; k < points.size(); ++k) points[k].value *= k % 2 == 0 ? 1.1 : 0.9;
  const auto fit = fit_order(points);
  EXPECT_NEAR(fit->order, 1.0, 3.0 * fit->order_error);
  EXPECT_GT(fit->order_error, 0.005);
}

TEST(ChartFit, NoiseRoundingAndLargeErrorsAreLeftOut) {
  std::vector<FitPoint> points = law(1.0, 1.0, 0.0);
  const std::size_t clean = fit_order(points)->points;
  points.push_back({1e-5, 0.5, 0.4});    // within the noise of its seeds
  points.push_back({1e-6, 1e-14, 0.0});  // rounding error
  points.push_back({1e-7, 0.1, 0.0});    // its standard error is 0 by chance
  points.push_back({1.0, 0.9, 0.0});     // not small
  const auto fit = fit_order(points);
  EXPECT_EQ(fit->points, clean);
  EXPECT_NEAR(fit->order, 1.0, 1e-12);
}

// Logarithms at -1, 0 and 1 times ln 2 with values 0, ln 2 and 0: the line is level, with squared residuals of 2/3, one
// degree of freedom, and a spread of 2.
TEST(ChartFit, TheErrorOfAnOrderIsThatOfALineThroughItsPoints) {
  const auto fit = fit_order({{0.04, 0.01, 0.0}, {0.02, 0.02, 0.0}, {0.01, 0.01, 0.0}});
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->order, 0.0, 1e-12);
  EXPECT_NEAR(fit->order_error, 1.0 / std::sqrt(3.0), 1e-12);
}

TEST(ChartFit, TwoPointsAreNoFit) {
  EXPECT_FALSE(fit_order({{0.1, 0.1, 0.0}, {0.01, 0.01, 0.0}}).has_value());
  EXPECT_FALSE(fit_order({}).has_value());
}

// For each seed differences are taken to the run of exact from the same start, which removes what both have in common.
TEST(ChartResult, RatesAreComparedSeedBySeed) {
  std::vector<std::vector<Sample>> samples;
  for (const double rate : {1.0, 2.0, 6.0}) {
    Sample exact{Method::exact, 0.0, {}}, pairwise{Method::pairwise, 0.01, {}};
    exact[Measure::rate] = rate;
    pairwise[Measure::rate] = rate - 0.03;
    exact[Measure::cost] = rate;
    pairwise[Measure::cost] = 2.0 * rate;
    samples.push_back({exact, pairwise});
  }
  const SceneResult result = summed_up(chart_scenes().at(1), samples);
  EXPECT_DOUBLE_EQ(result.unit, 1.0 / 3.0) << "the mean free time of exact";
  const Point& p = result.curves.at(1).points.at(0);
  EXPECT_EQ(p.seeds, 3U);
  EXPECT_NEAR(p[Measure::rate].value, -0.01, 1e-15);
  EXPECT_NEAR(p[Measure::rate].error, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(p.cost, 2.0 / 3.0) << "the least over the seeds";
}

TEST(ChartTable, CostIsReadOffBetweenPoints) {
  Curve curve{Method::pairwise, {}, {}};
  for (const double dt : {0.1, 0.01}) {
    Point p;
    p.dt = dt;
    p.cost = 1.0 / dt;
    p.errors[static_cast<std::size_t>(Measure::path)] = {dt, 0.0};
    curve.points.push_back(p);
  }
  EXPECT_NEAR(*cost_at(curve, Measure::path, 0.03), 1.0 / 0.03, 1e-9);
  EXPECT_DOUBLE_EQ(*cost_at(curve, Measure::path, 0.2), 10.0) << "the cheapest point is accurate enough";
  EXPECT_FALSE(cost_at(curve, Measure::path, 1e-3).has_value()) << "there is no extrapolation beyond the last point";
}

// In Brownian motion paths are compared with those of exact at the same interval, spreads with those at the shortest
// interval.
TEST(ChartTable, ASpreadCostsTheIntervalThatItTakesByExactToo) {
  Curve curve{Method::exact, {}, {}};
  for (const double dt : {0.1, 0.01, 0.001}) {
    Point p;
    p.dt = dt;
    p.cost = 1.0 / dt;
    p.errors[static_cast<std::size_t>(Measure::figure)] = {dt > 0.001 ? dt : 0.0, 1e-4};
    curve.points.push_back(p);
  }
  EXPECT_DOUBLE_EQ(*cost_at(curve, Measure::path, 1e-9), 10.0);
  EXPECT_NEAR(*cost_at(curve, Measure::figure, 0.03), 1.0 / 0.03, 1e-9);
  EXPECT_FALSE(cost_at(curve, Measure::figure, 1e-3).has_value()) << "an error within the noise is unknown";
}

}  // namespace
}  // namespace carom::chart
