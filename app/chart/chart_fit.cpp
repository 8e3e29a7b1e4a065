#include "app/chart/chart_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/column.hpp"

namespace carom::chart {

bool is_seen(const FitPoint& p) {
  return std::abs(p.value) > seen_errors * p.error && std::abs(p.value) > rounding_floor;
}

std::optional<OrderFit> fit_order(std::vector<FitPoint> points) {
  std::sort(points.begin(), points.end(), [](const FitPoint& a, const FitPoint& b) { return a.dt > b.dt; });
  std::vector<double> x, y;
  for (const FitPoint& p : points) {
    if (std::abs(p.value) > small_error) continue;
    if (!is_seen(p)) break;
    x.push_back(std::log(p.dt));
    y.push_back(std::log(std::abs(p.value)));
  }
  if (x.size() < 3) return std::nullopt;
  const Column log_dt = column_of(x), log_error = column_of(y);
  const Column dx = log_dt - log_dt.mean(), dy = log_error - log_error.mean();
  const double spread = dx.square().sum();
  const double order = (dx * dy).sum() / spread;
  const double variance = (dy - order * dx).square().sum() / (static_cast<double>(x.size()) - 2.0);
  return OrderFit{order, std::sqrt(variance / spread), std::exp(log_error.mean() - order * log_dt.mean()), x.size()};
}

}  // namespace carom::chart
