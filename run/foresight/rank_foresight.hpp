// What carom check predicts of a run on several ranks.
#pragma once

#include <string>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/slabs/slab_trial.hpp"

namespace carom {

struct RankForesight {
  int ranks = 1;
  double disks = 0.0;         // of each, in the mean
  double first_bytes = 0.0;   // memory of rank 0, which makes the start and writes the files
  double other_bytes = 0.0;   // of each of the others
  bool first_has_all = true;  // has rank 0 all disks at any time?
  SlabTraffic traffic;        // of a step and a rank
  std::string alone;          // why rank 0 runs all disks (SlabStart); empty: each has its own
};

// start: with all disks. Throws InputError for a method that ranks do not know. Where rank 0 has all disks, first_bytes
// is left to the caller, which has tried the run.
RankForesight foresee_ranks(const Scene& scene, const State& start, int ranks);

}  // namespace carom
