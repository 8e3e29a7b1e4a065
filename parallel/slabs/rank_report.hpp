// The distribution of a run's work on its ranks, and their traffic.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/ranks/traffic.hpp"

namespace carom {

// The load of one rank.
struct RankLoad {
  Count disks = 0;       // at present
  Count ghosts = 0;      // disks of other ranks, in the last step
  Count peak_bytes = 0;  // the most memory that its process has used so far
  Traffic in_steps;      // since the engine was made, without frames and checkpoints
};

struct RankReport {
  Count steps = 0;              // since the engine was made
  std::vector<RankLoad> ranks;  // in order of ranks

  // The most disks of a rank, over their mean; 1 without disks.
  double imbalance() const {
    Count most = 0;
    Count all = 0;
    for (const RankLoad& rank : ranks) {
      most = std::max(most, rank.disks);
      all += rank.disks;
    }
    return all == 0 ? 1.0 : static_cast<double>(most) * static_cast<double>(ranks.size()) / static_cast<double>(all);
  }

  // The sum over all ranks.
  Traffic traffic() const {
    Traffic sum;
    for (const RankLoad& rank : ranks) {
      sum.exchange.add(rank.in_steps.exchange);
      sum.all_reduce.add(rank.in_steps.all_reduce);
      sum.gather.add(rank.in_steps.gather);
      sum.seconds += rank.in_steps.seconds;
    }
    return sum;
  }
};

}  // namespace carom
