// Moving all disks, in blocks.
#pragma once

#include <vector>

#include "core/disks/disks.hpp"
#include "core/physics/contact_event.hpp"
#include "core/physics/resolve.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Drifts every disk by t (negative: back) and wraps centres across periodic sides. Returns the largest squared speed
// after it; block_speed2 is scratch. Each disk by itself: no order can matter.
double drift_blocks(Disks& disks, const Domain& box, double gravity, double t, const Executor& executor,
                    std::vector<double>& block_speed2);

// The wall contacts of all disks, buffer by buffer in storage order; empty buffers without walls.
void find_wall_contacts(Disks& disks, const StepRules& rules, const Executor& executor,
                        std::vector<std::vector<ContactEvent>>& buffers);

}  // namespace carom
