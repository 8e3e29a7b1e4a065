// The disks near the borders of a slab, as they are when nothing moves: for what looks at pairs between two steps.
#pragma once

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/border_search.hpp"

namespace carom {

// How far a disk of any rank has left its slab; length. Collective.
double excursion_over_ranks(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own);

// Each disk once, where it is in the box, with a radius and a mass of its own.
struct BorderDisks {
  Disks own, others;  // this rank's, and those of its neighbours
};

// All pairs of a rank and a neighbour whose centres are no further from each other than reach (length) plus the smaller
// of their radii are among own and others, on both ranks, but for those that meet across the slab of a third rank.
// excursion: excursion_over_ranks. Collective.
BorderDisks disks_at_borders(Ranks& ranks, const Slab& slab, const Domain& box, const Disks& own, double reach,
                             double excursion);

// Are all disks within reach (length) of a rank's own ones of this rank or a neighbour? Where there are more than two.
bool is_within_neighbours(const SlabCut& cut, const Domain& box, double reach, double excursion);

// All disks of both, those of the first one first.
Disks joined(const Disks& first, const Disks& second);

}  // namespace carom
