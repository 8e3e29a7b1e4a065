// What every rank must know of all disks together before it takes its part of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disk_source.hpp"
#include "core/disks/disks.hpp"
#include "core/scene/scene.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/moving_disks.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

struct SlabStart {
  SlabCut cut;
  DiskColumns columns;
  double smallest_radius = 0.0;     // of all disks; length
  double largest_radius = 0.0;      // also of those that sources may bring
  std::vector<std::size_t> counts;  // of disks, for each class of radii
  Count disks = 0;
  // Why one rank has to run the scene (lone_rank.hpp); empty if slabs run it.
  std::string alone;
};

// Throws InputError for a method that several ranks cannot run.
void check_ranks_know(Method method);

// Precondition: check_ranks_know(scene.run.method).
SlabStart slab_start(const Scene& scene, const Disks& all, int ranks);

// The same for disks that come in pieces; the slabs differ a little. Reads the disks once, or twice if radii differ.
SlabStart slab_start(const Scene& scene, DiskSource& all, int ranks);

// The same before it is known where the disks are: without a cut, and without the numbers of each class. smallest,
// largest: radii of all disks at the start.
SlabStart slab_start(const Scene& scene, DiskColumns columns, double smallest, double largest, Count disks, int ranks);

// The least thickness of each slab; length.
double thinnest_slab(const Scene& scene, const SlabStart& start);

Bytes message_of(const SlabStart& start);
SlabStart slab_start_of(const Bytes& message);

// Each rank takes the disks in its slab from all disks, which rank 0 has or reads. all: null on the other ranks. part:
// the radius and mass that disks share, as columns that are absent; its own disks are dropped. Collective.
Disks deal_out(Ranks& ranks, const SlabStart& start, DiskSource* all, Disks part);

// Keeps only the disks that are in this rank's slab, and frees the memory of the others.
void keep_own_disks(const SlabCut& cut, int rank, Disks& disks);

}  // namespace carom
