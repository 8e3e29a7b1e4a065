// chart.csv: every number of the chart.
#pragma once

#include <string>

#include "app/chart/chart_result.hpp"

namespace carom::chart {

// One line for each point and measure. cost in CPU seconds per disk and mean free time (per disk and diameter^2 / D for
// Brownian motion); orders are empty if there is no fit or no prediction. Lines of scenes "fluid_N" are for the fluid
// with N disks; their measure is the number of frames needed to advance by dt.
std::string csv_of(const ChartResult& result);

// The lowest cost at which a curve's error in a measure is at most `error`: from its points, with straight lines in
// logarithms between them. For exact, whose error is too small to be seen, it is exact's cost, except for the spread of
// Brownian motion, in which exact has the error of its interval. None if the curve does not reach the error.
std::optional<double> cost_at(const Curve& curve, Measure measure, double error);

}  // namespace carom::chart
