// The method `exact` on several ranks, each with a slab of the box.
#pragma once

#include <memory>

#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/slab_start.hpp"
#include "parallel/threads/threads.hpp"

namespace carom {

// This rank's part of an engine that has the bits of make_parallel_exact on any number of ranks with any number of
// threads each. part: the initial state with the disks in the rank's slab; start: of all disks. step() and all
// functions that read disks are collective. The disks of state() are the rank's own; all else in it is that of the
// whole run. ranks outlives the engine.
// A rank processes the events of its own disks, and of its neighbours' disks up to a depth beyond its slab, as far as
// they do not depend on disks further away; after each slice it asks their ranks for the paths of the others. If slabs
// are too thin for that, rank 0 has all disks for a while and runs them alone (lone_rank.hpp), as it does after windows
// that are crowded, and always if the scene has a feature that slabs do not support (SlabStart).
// Preconditions: scene.run.method is exact, threads.count >= 1.
std::unique_ptr<Engine> make_slab_exact_part(const Scene& scene, State part, const SlabStart& start,
                                             const Threads& threads, Ranks& ranks);

// The same if all ranks have the same initial state, with all disks.
std::unique_ptr<Engine> make_slab_exact(const Scene& scene, State initial, const Threads& threads, Ranks& ranks);

}  // namespace carom
