// What carom check predicts of a run on several ranks.
#pragma once

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/slabs/slab_trial.hpp"

namespace carom {

struct RankForesight {
  int ranks = 1;
  double disks = 0.0;        // of each, in the mean
  double first_bytes = 0.0;  // memory of rank 0, which makes the start and writes the files
  double other_bytes = 0.0;  // of each of the others
  SlabTraffic traffic;       // of a step and a rank
};

// start: with all disks. Throws InputError where so many ranks cannot run the scene. first_bytes is left to whoever has
// tried the run.
RankForesight foresee_ranks(const Scene& scene, const State& start, int ranks);

}  // namespace carom
