// The predictions of carom check for a run on several ranks.
#pragma once

#include <string>

#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "parallel/slabs/slab_trial.hpp"

namespace carom {

struct RankForesight {
  int ranks = 1;
  double disks = 0.0;         // of each rank, on average
  double first_bytes = 0.0;   // memory of rank 0, which makes the initial state and writes the files
  double other_bytes = 0.0;   // memory of each other rank
  bool first_has_all = true;  // does rank 0 hold all disks at some time?
  SlabTraffic traffic;        // of one rank in a step
  std::string alone;          // the reason why rank 0 runs all disks (SlabStart); empty: each rank runs its own
};

// start: the state with all disks. Throws InputError for a method that does not run on ranks. If rank 0 holds all
// disks, the caller, which has made trial steps, has to set first_bytes.
RankForesight foresee_ranks(const Scene& scene, const State& start, int ranks);

}  // namespace carom
