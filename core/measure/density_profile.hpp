// How disks are spread along an axis: their number and the room that they take up, slab by slab.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks_in_pieces.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Equal slabs across the box. Disks are counted where their centres are; the area of a disk is shared out exactly among
// the slabs that it reaches, round the corner of a periodic side.
struct DensityProfile {
  std::vector<Count> centres;   // summed over the samples
  std::vector<double> covered;  // area, likewise; length^2
  Count samples = 0;
};

DensityProfile empty_density(std::size_t slabs);

void add_density(DensityProfile& profile, const DisksInPieces& disks, const Domain& box, bool along_x);
inline void add_density(DensityProfile& profile, const Disks& disks, const Domain& box, bool along_x) {
  add_density(profile, WholeDisks(disks, 0.0), box, along_x);
}

// Adds the samples of another profile with as many slabs.
void join(DensityProfile& profile, const DensityProfile& other);

// Part of a disk of radius 1 that lies below the line y = h: 0 for h <= -1, 1 for h >= 1.
double share_below(double h);

}  // namespace carom
