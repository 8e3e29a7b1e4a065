// The standard error of the mean of samples that are correlated in time, by blocking.
#pragma once

#include <vector>

namespace carom {

// Neighbouring samples are averaged in pairs, again and again; the estimate deviation / sqrt(blocks - 1) rises until
// blocks are longer than the correlations (Flyvbjerg and Petersen, J. Chem. Phys. 91, 461 (1989)). The largest of the
// estimates with 32 blocks or more, which is sure of itself to an eighth; with fewer samples that of the samples
// themselves. Where even these longest blocks are correlated, each with the next one (as in a gas between thermal
// walls, until heat has crossed the box), the error is larger by what that correlation says. In the unit of the
// samples. weights: empty, or one an entry; then the error is that of the weighted mean. Entries that are NaN or weigh
// nothing do not count. NaN below two samples.
double blocking_error(const std::vector<double>& series, const std::vector<double>& weights = {});

}  // namespace carom
