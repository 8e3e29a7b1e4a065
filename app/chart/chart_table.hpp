// chart.csv: every number of the chart.
#pragma once

#include <string>

#include "app/chart/chart_result.hpp"

namespace carom::chart {

// One line a point and measure. cost in CPU seconds per disk and mean free time (per disk and diameter^2 / D for
// Brownian motion); orders are empty where there is no fit or no prediction. Lines of scenes "fluid_N" are the
// fluid with N disks; their measure is the frames that it took to advance by dt.
std::string csv_of(const ChartResult& result);

// Cheapest cost at which a curve's error in a measure is at most `error`: read off its points, between two of them
// along the straight line of logarithms. Exact, whose error is below what can be seen, gives its cost, but for the
// spread of Brownian motion, in which it has the error of its interval. None where the curve does not reach so far.
std::optional<double> cost_at(const Curve& curve, Measure measure, double error);

}  // namespace carom::chart
