// What lies near the borders of a slab: how far disks have left it, which of them the neighbours must see, and which of
// their disks touch one of it.
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

// A rank's slab. A border is one that another rank lies beyond; the floor of a box with walls is none.
struct Slab {
  double low = 0.0, high = 0.0;  // length
  bool has_lower = false, has_upper = false;
};

Slab slab_of(const SlabCut& cut, const Domain& box, int rank);

// How far a centre lies beyond the borders; length, negative within.
struct Beyond {
  double lower, upper;
};
Beyond beyond(const Slab& slab, const Domain& box, double y);

// The disks, by storage index and each once, that may lie within depth (length) of a border or beyond it; others too.
// Precondition: the strays in cells.coarse are of where the disks are now.
void find_near_borders(const Slab& slab, const Disks& disks, const CellList& cells, double depth,
                       std::vector<std::uint32_t>& near);

// How far the furthest of these disks has left the slab; length, 0 if none has.
double excursion_of(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near);

// Of these disks, those that may touch a disk beyond a border: one whose radius is at most largest_radius, and whose
// centre has left its own slab by at most excursion (length).
struct SeenBeyond {
  std::vector<Disk> below, above;
};
void find_seen_beyond(const Slab& slab, const Domain& box, const Disks& disks, const std::vector<std::uint32_t>& near,
                      double largest_radius, double excursion, SeenBeyond& seen);

// Sends them to the neighbours, and returns what these have sent: the disks of the rank below, and of that above.
SeenBeyond exchange_seen(Ranks& ranks, const SeenBeyond& seen);

// The pairs of a rank's own disk and a ghost that touch or overlap, own disk first. furthest: FoundContacts::furthest
// of the search among own disks.
void find_crossing_pairs(const Disks& disks, const Domain& box, const GhostDisks& ghosts, const CellList& cells,
                         double furthest, std::vector<Pair>& pairs);

}  // namespace carom
