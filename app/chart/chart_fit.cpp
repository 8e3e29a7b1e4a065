#include "app/chart/chart_fit.hpp"

#include <algorithm>
#include <cmath>

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
  const double n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, sxx = 0.0, sxy = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mx += x[k] / n;
    my += y[k] / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    sxx += (x[k] - mx) * (x[k] - mx);
    sxy += (x[k] - mx) * (y[k] - my);
  }
  const double order = sxy / sxx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - my - order * (x[k] - mx);
    rest += off * off;
  }
  return OrderFit{order, std::sqrt(rest / (n - 2.0) / sxx), std::exp(my - order * mx), x.size()};
}

}  // namespace carom::chart
