// The standard error of the mean of samples that are correlated in time, by blocking.
#pragma once

#include <vector>

namespace carom {

// Neighbouring samples are averaged in pairs, again and again; the estimate deviation / sqrt(blocks - 1) rises until
// blocks are longer than the correlations (Flyvbjerg and Petersen, J. Chem. Phys. 91, 461 (1989)). Returns the largest
// estimate from 32 blocks or more, each of which is known to about an eighth of itself; below 64 samples, the estimate
// from the samples themselves. If even the longest blocks are correlated, each with the next one (as in a gas between
// thermal walls, until heat has crossed the box), the error is enlarged by what that correlation implies. In the unit
// of the samples. weights: empty, or one for each sample; then the error is that of the weighted mean. Samples that are
// NaN or have no weight do not count. Below two samples the result is NaN.
double blocking_error(const std::vector<double>& series, const std::vector<double>& weights = {});

}  // namespace carom
