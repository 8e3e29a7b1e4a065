// The events of a slice of a window, shared out among tiles and threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/physics/impact_tally.hpp"
#include "parallel/exact/event_processor.hpp"
#include "parallel/exact/neighbour_lists.hpp"
#include "parallel/exact/window_state.hpp"
#include "parallel/exact/worker.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// How a slice ended. Unless it is `done`, nothing of the window counts: a disk was faster than the speed bound; the
// window is crowded (core/step/window_length.hpp); it was given up.
enum class SliceOutcome : std::uint8_t { done, too_fast, crowded, given_up };

// With a single queue, a window is one slice, and one worker processes its events. In tiled mode each thread has a
// region, a run of tiles, and goes through its tiles in order; in each it processes the events of the tile's disks as
// far as they do not depend on disks whose motion is not yet known. A disk that is blocked by one of a later tile is
// forwarded to that tile. A disk that lists one of another region, or is blocked by one that does, is deferred to a
// serial pass over the region borders. Which tile processes an event depends on the threads, the event does not.
class SliceScheduler {
 public:
  SliceScheduler(WindowState& window, NeighbourLists& lists, const Executor& executor)
      : window_(window), lists_(lists), executor_(executor) {}

  // A window begins, in window.mode. rebuilt: so do the lists.
  void begin_window(bool rebuilt);

  // The longest time that a slice may last; window.speed_bound has been set.
  double longest_slice() const;

  // Runs the slice, with about `expected` events. At inelastic collapse the result is `crowded` in tiled mode;
  // otherwise it throws PhysicsError.
  SliceOutcome run(double start, double end, double expected, double window_start);
  // Not in tiled mode: the event that tells that the window is crowded, the same as the reference's.
  const EventMark& crowding() const { return *serial_.crowded; }

  // Of the window so far.
  ImpactTally tally() const;
  Count events() const;
  bool any_gone() const;
  template <class Read>
  void read_logs(Read&& read) const {
    for (const Region& region : regions_) read(region.worker.log);
    read(serial_.log);
  }
  // Disks relisted since the lists were built.
  Count relisted() const { return relisted_; }

 private:
  // Tiles [first, last), contiguous in memory.
  struct Region {
    std::uint32_t first = 0, last = 0;
    Worker worker;
    std::vector<std::uint32_t> border;    // disks marked lists_other_region
    std::vector<std::uint32_t> deferred;  // numbers of blocked disks that no tile of the region can resolve
  };

  bool tiled() const { return window_.mode == EngineMode::tiled; }
  void lay_out_regions();
  void find_border(Region& region);
  void find_later_tiles(Region& region);
  void run_single_queue(double expected);
  void run_tiles(double expected);
  void begin_slice(Region& region);
  void run_region(Region& region, double expected);
  void begin_tile(Region& region, std::uint32_t tile, double expected);
  void activate(std::uint32_t tile, const std::vector<BlockedDisk>& blocked);
  void queue_tile(std::uint32_t tile, const std::vector<BlockedDisk>& blocked, EventProcessor<true>& events);
  void finish_tile(Region& region, std::uint32_t tile, std::size_t first_blocked);
  void run_serial_pass(double expected);
  void begin_queue(Worker& worker, double expected);
  SliceOutcome outcome() const;

  WindowState& window_;
  NeighbourLists& lists_;
  const Executor& executor_;
  std::vector<Region> regions_;                        // tiled mode
  std::vector<std::vector<std::uint32_t>> forwarded_;  // to each tile: numbers of blocked disks
  Worker serial_;                                      // single queue: all disks; tiled mode: the serial pass
  Count relisted_ = 0;
};

}  // namespace carom
