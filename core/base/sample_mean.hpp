// Mean and scatter of a series of samples.
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace carom {

// Entries that are NaN do not count. mean: weighted if there are weights. deviation: standard deviation of one sample,
// sqrt(sum (x - mean)^2 / (n - 1)); 0 below two samples.
struct SampleMean {
  double mean = 0.0;
  double deviation = 0.0;
  Count samples = 0;

  // Standard error of the mean if samples are independent and have equal weights: deviation / sqrt(samples).
  double standard_error() const;
};

// weights: empty, or one for each entry.
SampleMean sample_mean(const std::vector<double>& series, const std::vector<double>& weights = {});

}  // namespace carom
