// Moving all disks of a sheared box, in blocks.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/physics/impact_tally.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Drifts every disk by t, and brings those that have crossed a side back into the box; with t = 0 those that contacts
// have moved. Adds the work of the shear to the tally. Returns the largest squared speed. block_values: scratch.
double move_sheared(Disks& disks, const Domain& box, double t, const Executor& executor, ImpactTally& tally,
                    std::vector<double>& block_values);

}  // namespace carom
