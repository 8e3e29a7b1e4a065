// Results of the chart from samples by hand: means over seeds, the table, and the text for a user's own scene.
#include "app/chart/chart_result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/chart/chart_table.hpp"
#include "app/chart/chart_text.hpp"
#include "core/load/scene_file.hpp"

namespace carom::chart {
namespace {

using ::testing::HasSubstr;

const ChartScene& scene_named(const std::string& name) {
  return *std::ranges::find(chart_scenes(), name, &ChartScene::name);
}

Sample sample_of(Method method, double dt, double rate, double figure, double cost = 1.0) {
  Sample sample{method, dt, {}};
  sample[Measure::rate] = rate;
  sample[Measure::figure] = figure;
  sample[Measure::cost] = cost;
  sample[Measure::path] = 0.25;
  return sample;
}

const Point& point(const SceneResult& result, Method method, double dt) {
  const auto& curve = *std::ranges::find(result.curves, method, &Curve::method);
  return *std::ranges::find(curve.points, dt, &Point::dt);
}

// 1, 2 and 6 have a mean of 3 with a standard error of sqrt(7 / 3).
TEST(ChartResult, ExactsErrorIsHowWellItsMeanIsKnown) {
  std::vector<std::vector<Sample>> samples;
  for (const double rate : {1.0, 2.0, 6.0}) {
    samples.push_back({sample_of(Method::exact, 0.0, rate, 2.0 * rate), sample_of(Method::pairwise, 0.01, rate, rate)});
  }
  const SceneResult result = summed_up(scene_named("fluid"), samples);
  const Point& exact = point(result, Method::exact, 0.0);
  EXPECT_EQ(exact[Measure::rate].value, 0.0);
  EXPECT_NEAR(exact[Measure::rate].error, std::sqrt(7.0 / 3.0) / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.figure, 6.0);
  const Point& pairwise = point(result, Method::pairwise, 0.01);
  EXPECT_NEAR(pairwise[Measure::figure].value, -0.5, 1e-12);
  EXPECT_NEAR(pairwise[Measure::figure].error, std::sqrt(7.0 / 3.0) / 6.0, 1e-12);
  EXPECT_EQ(pairwise[Measure::path].value, 0.25);
  EXPECT_EQ(pairwise[Measure::path].error, 0.0);
}

TEST(ChartResult, ASingleRunMayBeWrongByAllOfIt) {
  const SceneResult result = summed_up(
      scene_named("fluid"), {{sample_of(Method::exact, 0.0, 4.0, 1.0), sample_of(Method::pairwise, 0.01, 3.0, 1.0)}});
  EXPECT_EQ(point(result, Method::pairwise, 0.01)[Measure::path].error, 0.25);
  EXPECT_NEAR(point(result, Method::pairwise, 0.01)[Measure::rate].value, -0.25, 1e-15);
  EXPECT_NEAR(point(result, Method::pairwise, 0.01)[Measure::rate].error, 0.25, 1e-15);
  EXPECT_EQ(point(result, Method::exact, 0.0)[Measure::rate].error, 1.0);
}

// Spreads are compared with those of exact at the shortest step, rates with those of exact at the same step.
TEST(ChartResult, BrownianSpreadsAreComparedWithTheShortestStep) {
  std::vector<std::vector<Sample>> samples;
  for (const double shift : {-0.05, 0.05}) {
    samples.push_back(
        {sample_of(Method::exact, 0.004, 8.0, 0.6 + shift), sample_of(Method::pairwise, 0.004, 6.0, 0.55 + shift),
         sample_of(Method::exact, 0.001, 16.0, 0.5 + shift), sample_of(Method::pairwise, 0.001, 16.0, 0.5 + shift)});
  }
  const ChartScene& scene = scene_named("brownian");
  const SceneResult result = summed_up(scene, samples);
  EXPECT_EQ(result.unit, scene.unit);
  EXPECT_DOUBLE_EQ(result.figure, 0.5);
  EXPECT_NEAR(point(result, Method::exact, 0.004)[Measure::figure].value, 0.2, 1e-12);
  EXPECT_NEAR(point(result, Method::pairwise, 0.004)[Measure::figure].value, 0.1, 1e-12);
  EXPECT_NEAR(point(result, Method::pairwise, 0.001)[Measure::figure].value, 0.0, 1e-12);
  EXPECT_EQ(point(result, Method::exact, 0.001)[Measure::figure].value, 0.0);
  EXPECT_NEAR(point(result, Method::exact, 0.001)[Measure::figure].error, 0.05 / 0.5, 1e-12);
  EXPECT_NEAR(point(result, Method::pairwise, 0.004)[Measure::rate].value, -0.25, 1e-12);
}

TEST(ChartResult, OrdersArePredictedOfCollisionsAlone) {
  for (const Measure measure : {Measure::path, Measure::rate, Measure::figure, Measure::missed, Measure::spurious}) {
    EXPECT_EQ(predicted_order(scene_named("fluid"), Method::pairwise, measure), 1.0);
    EXPECT_EQ(predicted_order(scene_named("brownian"), Method::rollback, measure), 0.5);
    EXPECT_FALSE(predicted_order(scene_named("fluid"), Method::exact, measure));
  }
  EXPECT_FALSE(predicted_order(scene_named("fluid"), Method::pairwise, Measure::energy));
}

// A point of a curve, with an error of its paths.
Point point_at(double dt, double cost, double path, double error = 0.0) {
  Point p;
  p.dt = dt;
  p.seeds = 3;
  p.cost = cost;
  p.errors.fill({undefined, undefined});
  p.errors[static_cast<std::size_t>(Measure::path)] = {path, error};
  return p;
}

// Two steps of pairwise, and exact, with half a unit of time as the unit.
SceneResult by_hand() {
  SceneResult result{scene_named("fluid"), 0.5, 1.0, {}, {}};
  result.scene.name = "mine";
  Curve pairwise{Method::pairwise, {point_at(0.02, 1e-6, 0.04), point_at(0.01, 3e-6, 0.002, 0.02)}, {}};
  pairwise.fits[static_cast<std::size_t>(Measure::path)] = OrderFit{1.25, 0.5, 2.0, 3};
  Curve exact{Method::exact, {point_at(0.0, 5e-6, 1e-14)}, {}};
  result.curves = {pairwise, exact};
  result.stops = {{Method::rollback, 0.04, "too fast"}};
  return result;
}

TEST(ChartTable, HasALineAPointAndMeasure) {
  ChartResult result;
  result.scenes = {by_hand()};
  result.crowd = {{64, Method::pairwise, 0.032, 2e-6, 1.5}};
  EXPECT_EQ(
      csv_of(result),
      "scene,method,dt,seeds,cost,measure,error,standard_error,seen,fitted_order,fitted_order_error,predicted_order\n"
      "mine,pairwise,0.02,3,1e-06,path,0.04,0,1,1.25,0.5,1\n"
      "mine,pairwise,0.01,3,3e-06,path,0.002,0.02,0,1.25,0.5,1\n"
      "mine,exact,0,3,5e-06,path,1e-14,0,0,,,\n"
      "fluid_64,pairwise,0.032,1,2e-06,frames,1.5,,,,,\n");
}

// Ten disks for 100 units of time are 200 units of the result: at 1e-6 s each this takes 2 ms. The error of the second
// step is within the noise, and may be twice its standard error.
TEST(ChartText, SaysWhatARunCostsAndWhichIsTheCheapest) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 20\n[[disks]]\ncount = 10\npositions = \"random\"\nradius = 0.5\nmass = 1\n[run]\n"
      "method = \"pairwise\"\ndt = 0.01\nt_end = 100\n",
      "mine.toml", "");
  const std::string text = own_chart_text(by_hand(), scene);
  EXPECT_THAT(text, ::testing::ContainsRegex("\n  pairwise  0\\.02 +3 +0\\.002 s +4\\.0e-02 +- +-\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("\n  pairwise  0\\.01 +3 +0\\.006 s +<4e-02 +- +-  the scene's dt\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("\n  exact  +3 +0\\.01 s +rounding +- +-\n"));
  EXPECT_THAT(text, HasSubstr("\n  rollback  0.04        stops: too fast\n"));
  EXPECT_THAT(text, HasSubstr("for a path error of 0.1: pairwise, dt = 0.02\n"));
  EXPECT_THAT(text, HasSubstr("for a path error of 0.01: exact\n"));
}

// Costs are per moving disk, so fixed disks add nothing: there are ten disks, as above.
TEST(ChartText, FixedDisksCostNothing) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 20\n[[disks]]\ncount = 10\npositions = \"random\"\nradius = 0.5\nmass = 1\n"
      "[[disks]]\nfixed = true\ncount = 90\npositions = \"random\"\nradius = 0.1\n[run]\n"
      "method = \"pairwise\"\ndt = 0.01\nt_end = 100\n",
      "pegs.toml", "");
  EXPECT_THAT(own_chart_text(by_hand(), scene), ::testing::ContainsRegex("\n  exact  +3 +0\\.01 s "));
}

}  // namespace
}  // namespace carom::chart
