// Density profiles along an axis: number of disks and covered area, slab by slab.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Equal slabs across the box. A disk is counted in the slab of its centre; its area is divided exactly among the slabs
// that it reaches, also across a periodic side.
struct DensityProfile {
  std::vector<Count> centres;   // summed over the samples
  std::vector<double> covered;  // area, summed over the samples; length^2
  Count samples = 0;
};

DensityProfile empty_density(std::size_t slabs);

void add_density(DensityProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x);
inline void add_density(DensityProfile& profile, const Disks& disks, const Domain& box, bool along_x) {
  add_density(profile, WholeDisks(disks, 0.0), box, along_x);
}

// Adds the samples of another profile with as many slabs.
void join(DensityProfile& profile, const DensityProfile& other);

// The share of a unit disk's area below the line y = h: 0 for h <= -1, 1 for h >= 1.
double share_below(double h);

}  // namespace carom
