// How the disks of one group move: their mean velocity, and the temperature around it.
#pragma once

#include <cstddef>
#include <span>

#include "core/disks/disks.hpp"

namespace carom {

struct GroupMotion {
  double kinetic = 0.0;      // sum of m v^2 / 2; energy
  double temperature = 0.0;  // sum of m (v - V)^2 / 2 over the number of disks; energy; NaN without any
  Vec2 velocity;             // V: momentum over mass; length / time; NaN without any
};

// members: storage indices in order of id, so that the sums have the same bits in any storage order. k_B = 1, two
// degrees of freedom a disk: a block with velocities = { maxwell = T } starts with temperature T.
GroupMotion group_motion(const Disks& disks, std::span<const std::size_t> members);

}  // namespace carom
