// Initial states made where they live: each rank makes the disks in its slab, with the bits of one machine.
#pragma once

#include <optional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"

namespace carom {

// Are the scene's disks of a kind that needs no rank to know them all? Lattices, and disks at random anywhere.
bool starts_on_slabs(const Scene& scene);

struct StartOnSlab {
  State part;  // with the disks in the rank's slab, in order of id
  SlabStart start;
};

// Collective. None, on all ranks, where the scene is one that one machine refuses, or slabs do: which of its disks is
// at fault, one machine says. Precondition: starts_on_slabs(scene).
std::optional<StartOnSlab> start_on_slab(const Scene& scene, Ranks& ranks);

}  // namespace carom
