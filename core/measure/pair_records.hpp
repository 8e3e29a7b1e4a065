// What the pair correlation gathers: pairs by distance, of all disks and of groups.
#pragma once

#include <vector>

#include "core/base/block_runner.hpp"
#include "core/measure/pair_distances.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct PairRecord {
  std::vector<Count> counts;  // ordered pairs, by bin, summed over the samples
  Count centres = 0;          // likewise, disks whose surroundings were counted
  double expected = 0.0;  // likewise, n (n - 1) / A: ordered pairs that n disks anywhere in A make in a unit of area
};

DistanceBins distance_bins(const DistancePlan& plan);

// The pairs of one moment that the plan asks for: those of the disks that are measured, and those of its groups (k, l),
// k <= l, in order of k, then l: of k alone, and of k and l taken together. box: at the time of the disks.
std::vector<PairCounts> pairs_of_plan(const AnalysisPlan& plan, const Disks& all, const Domain& box,
                                      const BlockRunner& run);

// Adds them. partial: of the groups, in the same order, l with k in place of both together.
void add_pairs(PairRecord& measured, std::vector<PairRecord>& partial, const AnalysisPlan& plan, const Domain& box,
               const std::vector<PairCounts>& found);

}  // namespace carom
