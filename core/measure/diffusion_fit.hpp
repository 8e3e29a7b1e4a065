// The diffusion coefficient that a mean square displacement shows at late times.
#pragma once

#include <vector>

namespace carom {

// D of <r^2> = 2 d D t + constant in d dimensions; length^2 / time.
struct DiffusionFit {
  double value = 0.0;  // NaN where there are too few samples
  double error = 0.0;  // standard error; NaN likewise
  double from = 0.0;   // time of the first sample that counts
};

// The second half of the samples (in time) in eight parts of about the same length: the slope from end to end, and its
// standard error from the scatter of the parts' slopes, whose errors are independent where displacements are, as those
// of a random walk. Means nothing where disks still fly freely, or where walls stop them. square: of each time; NaN
// where no disk is left. Precondition: times rise.
DiffusionFit fit_diffusion(const std::vector<double>& time, const std::vector<double>& square, double dimensions = 2.0);

}  // namespace carom
