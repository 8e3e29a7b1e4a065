// What every rank has to know of all disks together to take its part of them.
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
  double largest_radius = 0.0;      // those that sources may bring too
  std::vector<std::size_t> counts;  // of disks of each class of radii
  Count disks = 0;
  // Why one rank has to run the scene (lone_rank.hpp); empty: slabs do.
  std::string alone;
};

// Throws InputError for a method that several ranks cannot run.
void check_ranks_know(Method method);

// Precondition: check_ranks_know(scene.run.method).
SlabStart slab_start(const Scene& scene, const Disks& all, int ranks);

// The same of disks that come some at a time; its slabs differ a little. Reads them once, or twice where radii differ.
SlabStart slab_start(const Scene& scene, DiskSource& all, int ranks);

// The same before it is known where the disks are: without a cut, and how many there are of each class. Radii: of all
// disks that there are.
SlabStart slab_start(const Scene& scene, DiskColumns columns, double smallest, double largest, Count disks, int ranks);

// How thick each slab has to be; length.
double thinnest_slab(const Scene& scene, const SlabStart& start);

Bytes message_of(const SlabStart& start);
SlabStart slab_start_of(const Bytes& message);

// Each rank takes the disks in its slab of all that rank 0 has, or reads. all: null on the other ranks. part: what
// disks share, as columns that are not there; its own disks go. Collective.
Disks deal_out(Ranks& ranks, const SlabStart& start, DiskSource* all, Disks part);

// The disks that are in this rank's slab: others leave, and their memory is given back.
void keep_own_disks(const SlabCut& cut, int rank, Disks& disks);

}  // namespace carom
