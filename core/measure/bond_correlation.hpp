// The bond-orientational correlation g6(r): the correlation of psi6 of two disks at distance r.
#pragma once

#include <vector>

#include "core/base/block_runner.hpp"
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

// The pairs of one moment; the same for any order of storage and any runner. orders: disks with psi6 in place of
// velocities (with_orders).
BondPairs bond_pairs(const Disks& orders, const Domain& box, const DistanceBins& bins,
                     const BlockRunner& run = run_in_order);

// Adds the pairs as one sample. Precondition: the sums have as many bins.
void add_bond_pairs(BondCorrelation& sums, const BondPairs& found);

}  // namespace carom
