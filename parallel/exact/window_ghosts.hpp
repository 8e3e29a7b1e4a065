// What the exact engine on one of several ranks asks of the others. A rank has its own disks, and ghosts: disks of
// other ranks that are near. It processes the events of both, as far as they are known.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/exact/known_band.hpp"
#include "parallel/exact/slice_outcome.hpp"
#include "parallel/exact/window_state.hpp"

namespace carom {

class WindowGhosts {
 public:
  WindowGhosts() = default;
  WindowGhosts(const WindowGhosts&) = delete;
  WindowGhosts& operator=(const WindowGhosts&) = delete;
  virtual ~WindowGhosts() = default;

  // Is disk i, by storage index, a ghost?
  virtual bool is_ghost(std::uint32_t i) const = 0;

  // The part of the box whose disks the rank had as its own when ghosts were chosen: between two heights.
  struct Heights {
    double low, high;
  };
  virtual Heights own_heights() const = 0;

  // The band into which no disk comes in this window that is not here, unless strangers_come_near says so on a rank
  // that has that disk. slice_flight: no disk goes further in a slice; length, the same on all ranks.
  virtual KnownBand band(double slice_flight) = 0;
  // At the start of a slice: may disks of this rank that a neighbour does not have come into that one's band in it?
  virtual bool strangers_come_near(const WindowState& window) const = 0;

  // All of these are collective: each rank calls them at the same places.

  // The smallest of all ranks' numbers.
  virtual double least_of_all(double here) = 0;
  // How a slice has ended on all ranks: `done` only if it is that on each. events: of this rank's slice, becomes that
  // of all.
  virtual SliceOutcome agree(SliceOutcome here, Count& events) = 0;
  // Gives these disks, all of them ghosts, their paths at the slice's end, from the ranks that own them: what happened
  // to them in the slice is not known here.
  virtual void learn(WindowState& window, const std::vector<std::uint32_t>& unknown) = 0;
};

}  // namespace carom
