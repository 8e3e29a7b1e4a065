// Moves all disks of a sheared box, in blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/impact_tally.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Scratch for each block: its largest squared speed, and its disks that have crossed a side.
struct ShearedBlocks {
  std::vector<double> speed2;
  std::vector<std::vector<std::uint32_t>> crossed;
};

// Drifts every disk by t, and wraps those that have crossed a side. (t = 0 only wraps, for disks that contacts have
// moved.) Adds the work of the shear to the tally. Returns the largest squared speed.
double move_sheared(Disks& disks, const Domain& box, double t, const Executor& executor, ImpactTally& tally,
                    ShearedBlocks& blocks);

}  // namespace carom
