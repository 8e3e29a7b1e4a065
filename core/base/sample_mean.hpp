// Mean and scatter of a series of samples.
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace carom {

// Entries that are NaN do not count. mean: weighted where there are weights. deviation: of one sample,
// sqrt(sum (x - mean)^2 / (n - 1)), 0 below two samples.
struct SampleMean {
  double mean = 0.0;
  double deviation = 0.0;
  Count samples = 0;

  // Of the mean, where samples are independent and weigh the same: deviation / sqrt(samples).
  double standard_error() const;
};

// weights: empty, or one an entry.
SampleMean sample_mean(const std::vector<double>& series, const std::vector<double>& weights = {});

}  // namespace carom
