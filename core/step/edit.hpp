// A change that a program makes to a run between two steps: it adds or removes a disk, or changes a velocity.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/gravity.hpp"
#include "core/disks/state.hpp"

namespace carom {

struct Edit {
  enum class Kind : std::uint8_t { add, remove, set_velocity };
  Kind kind = Kind::add;
  Disk disk;              // add: all members, with the next free id; set_velocity: vx and vy only
  std::size_t index = 0;  // remove, set_velocity: where the disk is stored
  double energy = 0.0;    // energy_brought(); counted with the energy that sources bring
};

// The kinetic, potential and rotational energy that a change brings in; < 0 if it takes some away.
double energy_brought(const Edit& edit, const Disks& disks, const Gravity& gravity);

// Makes the change in the state. A new disk is stored last; the last disk takes the place of a removed one.
// Precondition: a new disk overlaps nothing, and its numbers are in range.
void apply(const Edit& edit, State& state);

}  // namespace carom
