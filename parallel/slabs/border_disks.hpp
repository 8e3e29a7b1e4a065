// The disks near the borders of a slab at a moment between two steps, for the analysis of pairs.
#pragma once

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/border_search.hpp"

namespace carom {

// The largest distance of any rank's disk from its slab; length. Collective.
double excursion_over_ranks(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own);

// Each disk once, at its place in the box, with its own radius and mass.
struct BorderDisks {
  Disks own, others;  // of this rank, and of its neighbours
};

// All pairs of a rank and a neighbour whose centres are no further apart than reach (length) plus the smaller of their
// radii are among own and others, on both ranks, except for pairs that meet across the slab of a third rank. excursion:
// excursion_over_ranks. Collective.
BorderDisks disks_at_borders(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own, double reach,
                             double excursion);

// With more than two ranks: do all disks within reach (length) of a rank's own disks belong to it or to a neighbour?
bool is_within_neighbours(const SlabCut& cut, const Domain& box, double reach, double excursion);

// All disks of both, those of the first one first.
Disks joined(const Disks& first, const Disks& second);

}  // namespace carom
