// The bond-orientational correlation g6(r): how alike the hexagons around two disks at a distance are turned.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/measure/pair_distances.hpp"

namespace carom {

// Sums over the ordered pairs of a centre and any disk, by bin of their distance, and over the samples.
struct BondCorrelation {
  std::vector<double> product;  // Re(psi6 of one, conjugate, times psi6 of the other)
  std::vector<Count> pairs;
  Count samples = 0;
};

// Nothing is added with fewer than seven disks. In order of ids: the same bits in any storage order. Precondition: the
// sums have bins.bins entries.
void add_bond_correlation(BondCorrelation& sums, const Disks& disks, const Domain& box, const DistanceBins& bins);

}  // namespace carom
