// Histogram of speeds, to compare with the Maxwell-Boltzmann distribution.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"

namespace carom {

// Reduced speeds u = v sqrt(m / T), so that disks of any mass, and a cooling gas, can share one histogram: in
// equilibrium f(u) = u exp(-u^2 / 2). Bin k holds k max / bins <= u < (k + 1) max / bins.
struct SpeedHistogram {
  std::vector<Count> counts;
  Count beyond = 0;              // u >= max
  Count samples = 0;             // moments that were added
  double temperature_sum = 0.0;  // summed over the samples; energy
  double largest_seen = 0.0;     // u
};

// Adds the disks of one moment. temperature: mean kinetic energy of a disk (two degrees of freedom of T / 2 each); if
// it is 0, nothing is added.
void add_speeds(SpeedHistogram& histogram, const DisksInPieces& disks, double temperature, double max);
inline void add_speeds(SpeedHistogram& histogram, const Disks& disks, double temperature, double max) {
  add_speeds(histogram, WholeDisks(disks, 0.0), temperature, max);
}

// The share of the disks in bin k in equilibrium: exp(-u_k^2 / 2) - exp(-u_(k+1)^2 / 2), the integral of f.
double maxwell_share(double max, std::size_t bins, std::size_t k);

}  // namespace carom
