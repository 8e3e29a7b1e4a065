#include "core/base/sample_mean.hpp"

#include <cmath>
#include <limits>

namespace carom {

SampleMean sample_mean(const std::vector<double>& series, const std::vector<double>& weights) {
  SampleMean result;
  double sum = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (std::isnan(series[k])) continue;
    const double w = weights.empty() ? 1.0 : weights[k];
    sum += w * series[k];
    weight += w;
    ++result.samples;
  }
  const auto n = static_cast<double>(result.samples);
  result.mean = result.samples > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (const double x : series) {
    if (!std::isnan(x)) squares += (x - result.mean) * (x - result.mean);
  }
  if (result.samples > 1) result.deviation = std::sqrt(squares / (n - 1.0));
  return result;
}

}  // namespace carom
