// Removal of the disks that sinks take.
#pragma once

#include <vector>

#include "core/disks/state.hpp"

namespace carom {

// Removes each disk i with by[i] != no_sink and counts it for that sink. by has an entry for each disk.
void remove_taken(State& state, const std::vector<SinkNumber>& by);

}  // namespace carom
