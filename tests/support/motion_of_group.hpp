// The motion of some of the disks, in one call.
#pragma once

#include <cstddef>
#include <span>

#include "core/measure/group_motion.hpp"

namespace carom::test {

// members: storage indices. A group with velocities = { maxwell = T } starts with temperature T.
inline GroupMotion group_motion(const Disks& disks, std::span<const std::size_t> members) {
  GroupTally tally;
  tally.add(disks, members);
  tally.add_thermal(disks, members);
  return tally.motion();
}

}  // namespace carom::test
