// The exchange of the exact engine on one of several ranks with the others. A rank has its own disks, and ghosts:
// nearby disks of other ranks. It processes the events of both, as far as they are known.
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

  // The part of the box, between two heights, whose disks were the rank's own when ghosts were chosen.
  struct Heights {
    double low, high;
  };
  virtual Heights own_heights() const = 0;

  // The band into which no disk that this rank does not have comes in this window, unless strangers_come_near returns
  // true on the rank that has that disk. slice_flight: the most that a disk flies in a slice; length, the same on all
  // ranks.
  virtual KnownBand band(double slice_flight) = 0;
  // At the start of a slice: may disks of this rank that a neighbour does not have come into the neighbour's band in
  // it?
  virtual bool strangers_come_near(const WindowState& window) const = 0;

  // The following functions are collective: all ranks call them in the same order.

  // The smallest of all ranks' numbers.
  virtual double least_of_all(double here) = 0;
  // The outcome of a slice on all ranks: `done` only if it is `done` on each. events: of this rank's slice; becomes the
  // sum over all ranks.
  virtual SliceOutcome agree(SliceOutcome here, Count& events) = 0;
  // Gives these disks, all of them ghosts whose motion in the slice this rank does not know, their paths at the slice's
  // end, from the ranks that own them.
  virtual void learn(WindowState& window, const std::vector<std::uint32_t>& unknown) = 0;
};

}  // namespace carom
