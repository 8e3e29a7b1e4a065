// The counts of the pair correlation: pairs by distance, of all disks and of groups.
#pragma once

#include <vector>

#include "core/base/block_runner.hpp"
#include "core/measure/pair_distances.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct PairRecord {
  std::vector<Count> counts;  // ordered pairs, by bin, summed over the samples
  Count centres = 0;          // disks around which pairs were counted, summed over the samples
  double expected = 0.0;  // n (n - 1) / A, summed over the samples: ordered pairs of n disks at random in A, for each
                          // unit of area of a ring
};

DistanceBins distance_bins(const DistancePlan& plan);

// The pairs of one moment that the plan asks for: first those of all measured disks, then for its groups (k, l), k <=
// l, in order of k, then l: within k if k = l, otherwise within the union of k and l. box: at the time of the disks.
std::vector<PairCounts> pairs_of_plan(const AnalysisPlan& plan, const Disks& all, const Domain& box,
                                      const BlockRunner& run);

// Adds the pairs found. partial: of the groups, in the same order, but pairs between k and l instead of within their
// union.
void add_pairs(PairRecord& measured, std::vector<PairRecord>& partial, const AnalysisPlan& plan, const Domain& box,
               const std::vector<PairCounts>& found);

}  // namespace carom
