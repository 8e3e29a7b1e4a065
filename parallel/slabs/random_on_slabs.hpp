// Random addition by ranks each of which has only the disks near its own slab.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "parallel/slabs/start_disks.hpp"

namespace carom {

// Are all disks placed at random in the whole box, and, if they are equally large, are they few enough for it?
bool places_on_slabs(const Scene& scene);

// Bytes that each disk of a rank takes while it is placed; 0 if steps take more. Precondition: places_on_slabs.
double placing_bytes(const Scene& scene);

// The disks in a rank's slab, in order of id.
struct PlacedOnSlab {
  std::vector<double> x, y;  // length
  std::vector<DiskId> id;
};

// The places of all these disks in a rank's slab, as place_at_random of core finds them, bit for bit. cut: of the box
// whose lower side is `up` below that of the scene's box (length). Collective; nothing, on all ranks, if
// place_at_random gives up, or if a disk needs very many trials. Precondition: places_on_slabs, with disks that may all
// move.
std::optional<PlacedOnSlab> place_on_slabs(const Scene& scene, const StartDisks& disks, const SlabCut& cut, double up,
                                           Ranks& ranks);

}  // namespace carom
