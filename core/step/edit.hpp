// A change that a program makes to a run between two steps: a disk comes, goes, or gets another velocity.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/gravity.hpp"
#include "core/disks/state.hpp"

namespace carom {

struct Edit {
  enum class Kind : std::uint8_t { add, remove, set_velocity };
  Kind kind = Kind::add;
  Disk disk;              // add: all of it, with the id that is next; set_velocity: vx and vy
  std::size_t index = 0;  // of the others: where the disk is stored
  double energy = 0.0;    // that it brings, which counts as what sources bring; energy_brought
};

// What a change brings in energy of motion, position and rotation; below 0 where it takes some.
double energy_brought(const Edit& edit, const Disks& disks, const Gravity& gravity);

// Makes the change in the columns and in what the state remembers of the disk; a new disk is stored last, and the last
// one takes the place of one that goes. Precondition: the disk has room, and its numbers are in range.
void apply(const Edit& edit, State& state);

}  // namespace carom
