// Tiled mode: how far a disk may go while the motion of others is not known.
#pragma once

#include <cstdint>

#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"

namespace carom {

// In QueuedEvent::disk: it is the disk's safe time, not its next event.
inline constexpr std::uint32_t safe_time_bit = 0x80000000U;

// No disk is faster than window.speed_bound, so that a disk whose motion is not yet known cannot touch disk i before
// its safe time, gap / (speed_bound + own speed) after the moment up to which it is known. Disk i is blocked at its
// safe time; up to then its path is right, whatever happens elsewhere.
class SafeTimes {
 public:
  SafeTimes(WindowState& window, NeighbourLists& lists, Worker& worker)
      : window_(window), lists_(lists), worker_(worker) {}

  // Queues the safe time of the disk, whose motion is known up to `time`, if it is within the slice.
  void push(std::uint32_t i, double time);
  // The safe time that was queued has come; it may be later by now, if the disk's path has changed.
  void reach(std::uint32_t i, double time);
  // Disk i's motion is not known from now on, so that its active neighbours get safe times too. tile: what it waits
  // for, as in BlockedDisk.
  void block(std::uint32_t i, double time, std::uint32_t tile);
  // The tile that has to be processed before the motion of this unresolved disk is known.
  std::uint32_t blocking_tile(std::uint32_t i) const;

  // Disk i has a new list, and is in other disks' lists than before. Marks are set at once: the neighbours keep disk i
  // in their lists, however soon it is relisted.
  void mark_relisted(std::uint32_t i);

 private:
  struct SafeTime {
    double time = never;
    std::uint32_t tile = serial_pass;  // what it waits for, as in BlockedDisk
    bool any = false;                  // is a neighbour unresolved?
  };

  double known_until(std::uint32_t unresolved) const;
  double safe_time_from(std::uint32_t i, double time, std::uint32_t unresolved) const;
  SafeTime safe_time(std::uint32_t i, double time) const;
  void mark_other_region(std::uint32_t i);
  std::uint16_t region_of(std::uint32_t i) const { return window_.region_of_tile[lists_.tile_of(i)]; }

  WindowState& window_;
  NeighbourLists& lists_;
  Worker& worker_;
};

}  // namespace carom
