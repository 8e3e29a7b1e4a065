// Pairs of disks by their distance, at one moment.
#pragma once

#include <vector>

#include "core/base/fixed_point_sum.hpp"
#include "core/base/types.hpp"

namespace carom {

struct PairCounts {
  Count centres = 0;          // disks around which pairs were counted
  std::vector<Count> counts;  // ordered pairs from them, by bin
};

// Correlation of the bond orientation psi6 of the two disks of a pair.
struct BondPairs {
  std::vector<Count> counts;           // as PairCounts
  std::vector<FixedPointSum> product;  // of the same pairs: Re(psi6 of one, conjugate, times psi6 of the other)
};

}  // namespace carom
