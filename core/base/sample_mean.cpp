#include "core/base/sample_mean.hpp"

#include <cmath>
#include <limits>

#include "core/base/column.hpp"

namespace carom {

double SampleMean::standard_error() const {
  return deviation / std::sqrt(static_cast<double>(samples));
}

SampleMean sample_mean(const std::vector<double>& series, const std::vector<double>& weights) {
  const auto x = column_of(series);
  const Eigen::Array<bool, Eigen::Dynamic, 1> known = !x.isNaN();
  const Column weight = weights.empty() ? Column(known.cast<double>()) : Column(known.select(column_of(weights), 0.0));
  SampleMean result;
  result.samples = static_cast<Count>(known.count());
  result.mean = result.samples > 0 ? known.select(weight * x, 0.0).sum() / weight.sum()
                                   : std::numeric_limits<double>::quiet_NaN();
  if (result.samples > 1) {
    const double squares = known.select((x - result.mean).square(), 0.0).sum();
    result.deviation = std::sqrt(squares / (static_cast<double>(result.samples) - 1.0));
  }
  return result;
}

}  // namespace carom
