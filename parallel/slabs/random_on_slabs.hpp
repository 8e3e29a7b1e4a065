// Random addition by ranks that each know the disks near their own slab alone.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/start_disks.hpp"

namespace carom {

// Are all disks placed at random anywhere, and, where they are equally large, are they not too many for that?
bool places_on_slabs(const Scene& scene);

// Bytes that each disk of a rank takes while it is placed; 0 where steps take more. Precondition: places_on_slabs.
double placing_bytes(const Scene& scene);

// The disks in a rank's slab, in order of id.
struct PlacedOnSlab {
  std::vector<double> x, y;  // length
  std::vector<DiskId> id;
};

// Where place_at_random of core puts all these disks, bit for bit. cut: of the box whose lower side is `up` below that
// of the scene's box (length). Collective; none, on all ranks, where that gives up, or tries a disk in vain for long.
// Precondition: places_on_slabs, of disks that may all move.
std::optional<PlacedOnSlab> place_on_slabs(const Scene& scene, const StartDisks& disks, const SlabCut& cut, double up,
                                           Ranks& ranks);

}  // namespace carom
