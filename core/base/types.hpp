// The few scalar types that every folder shares.
#pragma once

#include <cstdint>

namespace carom {

// Identity of a disk: never changes, never reused, whatever order the disks are stored in.
// 32 bits: 4.29e9 disks ever born, sources included; halves the id column against 64.
using DiskId = std::uint32_t;

// Events, steps and disks counted over a run: 1e15 collisions must fit.
using Count = std::uint64_t;

struct Vec2 {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Vec2&) const = default;
};

}  // namespace carom
