// The order of convergence of a method from its errors at several steps.
#pragma once

#include <optional>
#include <vector>

namespace carom::chart {

struct FitPoint {
  double dt = 0.0;
  double value = 0.0;  // error, a mean over seeds
  double error = 0.0;  // its standard error
};

// value = coefficient dt^order
struct OrderFit {
  double order = 0.0;
  double order_error = 0.0;  // standard error, from the scatter about the line
  double coefficient = 0.0;
  std::size_t points = 0;
};

// A mean counts as seen if it is at least this many standard errors from zero.
inline constexpr double seen_errors = 2.0;

// The share of rounding in an error; below this a curve does not depend on dt.
inline constexpr double rounding_floor = 1e-11;

// Above this an error is no longer small and may deviate from its law.
inline constexpr double small_error = 0.2;

// Is the point above the noise of its seeds and above rounding?
bool is_seen(const FitPoint& p);

// Least squares of log value against log dt, from the longest step with a small error down to the first point that is
// not seen; a point further down that is seen by chance is not used. None with fewer than three points.
std::optional<OrderFit> fit_order(std::vector<FitPoint> points);

}  // namespace carom::chart
