// Emission on slabs: all ranks draw the same newcomers, and ask each other whether one overlaps a disk.
#pragma once

#include <utility>

#include "core/disks/disk_columns.hpp"
#include "core/disks/state.hpp"

namespace carom {

// Calls emit(own) while only the newcomers are in the state, and returns them. own: the disks of this rank; they are in
// the state again afterwards, also if emit throws.
template <class Emit>
Disks emit_alone(State& state, const Emit& emit) {
  Disks others = no_disks_like(state.disks);
  std::swap(others, state.disks);
  try {
    emit(std::as_const(others));
  } catch (...) {
    std::swap(others, state.disks);
    throw;
  }
  std::swap(others, state.disks);
  return others;
}

}  // namespace carom
