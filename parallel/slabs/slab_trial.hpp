// What ranks would say to each other in a run, found by trying its first steps with ranks that are threads.
#pragma once

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

struct SlabTraffic {
  double messages = 0.0, bytes = 0.0;  // of a step and a rank, in the mean
  Count steps = 0;                     // that were tried
  Count lone_steps = 0;                // those of them that one rank ran for all, as slabs were too thin or too crowded
  int ranks = 0;                       // on which they were tried
};

// Tries for so many seconds, but one step at least, on three ranks at most: an inner slab has two borders however many
// there are. start: with all disks. A trial that the physics stops counts as far as it went. Precondition: ranks >= 1.
SlabTraffic try_slabs(const Scene& scene, const State& start, int ranks, double seconds);

}  // namespace carom
