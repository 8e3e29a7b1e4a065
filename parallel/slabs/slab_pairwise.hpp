// The method `pairwise` on several ranks, each with a slab of the box.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// This rank's part of an engine that has the bits of make_parallel_pairwise on any number of ranks with any number of
// threads each. All ranks make it of the same scene and the same initial state, with all disks; of those each keeps the
// ones in its slab. step() is collective: all ranks call it, or none. Of state(), the disks are the rank's own, and all
// else is that of the whole run. ranks outlives the engine. Slabs that would be thinner than two diameters of
// the largest disk leave all disks to rank 0 (lone_rank.hpp). Preconditions: scene.run.method is pairwise, scene.run.dt
// > 0, threads.count >= 1.
std::unique_ptr<Engine> make_slab_pairwise(const Scene& scene, State initial, const Threads& threads, Ranks& ranks);

// The same where a rank has been given no more than its disks. part: the initial state with the disks in its slab;
// start: of all of them.
std::unique_ptr<Engine> make_slab_part(const Scene& scene, State part, const SlabStart& start, const Threads& threads,
                                       Ranks& ranks);

}  // namespace carom
