// The traffic of ranks in a run, found by trying its first steps with ranks that are threads.
#pragma once

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct SlabTraffic {
  double messages = 0.0, bytes = 0.0;  // mean of a step and a rank
  Count steps = 0;                     // number tried
  Count lone_steps = 0;  // those of them that one rank ran for all, since slabs were too thin or too crowded
  int ranks = 0;         // number used in the trial
};

// Tries for this number of seconds, but at least one step, on at most three ranks: an inner slab has two borders,
// however many ranks there are. start: with all disks. A trial that an error of the physics stops counts as far as it
// went. Precondition: ranks >= 1.
SlabTraffic try_slabs(const Scene& scene, const State& start, int ranks, double seconds);

}  // namespace carom
