// The disks near the borders of a slab: how far they have left it, which of them the neighbours must have as ghosts,
// and which of them touch a neighbour's disks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/ghost_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/stepping/coarse_positions.hpp"

namespace carom {

// A rank's slab. Only an end with another rank beyond it is a border; the floor of a box with walls is none.
struct Slab {
  double low = 0.0, high = 0.0;  // length
  bool has_lower = false, has_upper = false;
};

Slab slab_of(const SlabCut& cut, const Domain& box, int rank);

// The distance of a centre beyond each border; length, negative inside.
struct Beyond {
  double lower, upper;
};
Beyond beyond(const Slab& slab, const Domain& box, double y);

// All disks that may be within depth (length) of a border or beyond it, and some others, by storage index and each
// once. Precondition: the strays in cells.coarse are those of the present positions.
void find_near_borders(const Slab& slab, const Disks& disks, const CellList& cells, double depth,
                       std::vector<std::uint32_t>& near);

// The largest distance that one of these disks has left the slab by; length, 0 if none has.
double excursion_of(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near);

// Those of these disks that may touch a disk beyond a border whose radius is at most largest_radius and whose centre
// has left its own slab by at most excursion (length).
struct SeenBeyond {
  std::vector<Disk> below, above;
};
void find_seen_beyond(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near,
                      double largest_radius, double excursion, SeenBeyond& seen);

// Sends them to the neighbours, and returns what these have sent: disks of the rank below, and of the rank above.
SeenBeyond exchange_seen(Ranks& ranks, const SeenBeyond& seen);

// The pairs of a rank's own disk and a ghost that touch or overlap, own disk first. furthest: FoundContacts::furthest
// of the search among own disks.
void find_crossing_pairs(const Disks& disks, const Domain& box, const GhostDisks& ghosts, const CellList& cells,
                         double furthest, std::vector<Pair>& pairs);

}  // namespace carom
