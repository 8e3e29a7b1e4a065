// The method `pairwise` on several ranks, each with a slab of the box.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// This rank's part of an engine that has the bits of make_parallel_pairwise on any number of ranks with any number of
// threads each. All ranks call it with the same scene and the same initial state, with all disks, of which each keeps
// those in its slab. step() is collective: all ranks call it, or none. The disks of state() are the rank's own; all
// else in it is that of the whole run. ranks outlives the engine. If slabs would be thinner than two diameters of the
// largest disk, rank 0 has all disks (lone_rank.hpp). Preconditions: scene.run.method is pairwise, scene.run.dt > 0,
// threads.count >= 1.
std::unique_ptr<Engine> make_slab_pairwise(const Scene& scene, State initial, const Threads& threads, Ranks& ranks);

// The same if a rank has only its own disks. part: the initial state with the disks in its slab; start: of all disks.
std::unique_ptr<Engine> make_slab_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks);

}  // namespace carom
