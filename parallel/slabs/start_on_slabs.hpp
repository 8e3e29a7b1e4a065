// Initial states made in parts: each rank makes the disks in its slab, with the bits of one machine.
#pragma once

#include <optional>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"

namespace carom {

// Are the scene's disks such that no rank needs all of them? That is so for lattices, and for disks at random in the
// whole box.
bool starts_on_slabs(const Scene& scene);

struct StartOnSlab {
  State part;  // with the disks in the rank's slab, in order of id
  SlabStart start;
};

// Collective. Nothing, on all ranks, if the scene is one that one machine or slabs refuse: one machine then says which
// disk is at fault. Precondition: starts_on_slabs(scene).
std::optional<StartOnSlab> start_on_slab(const Scene& scene, Ranks& ranks);

}  // namespace carom
