// A slice of a window: every event of a short time, tile after tile, by all threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/physics/impact_tally.hpp"
#include "parallel/exact/exact_events.hpp"
#include "parallel/exact/exact_flight.hpp"
#include "parallel/exact/exact_lists.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// How a slice ended: only `done` counts. Or somebody was too fast for what was taken for granted; the window is crowded
// (core/step/window_length.hpp); it was given up.
enum class SliceEnd : std::uint8_t { done, too_fast, crowded, given_up };

// Few disks run alone, in one slice a window. More of them are swept in tiles that a cache holds: each thread has a
// region of tiles and goes through them in order, running all events of a tile that do not depend on what is still
// unknown. A disk of which something depends on a later tile is handed on to it. What depends on other regions is left
// over, for one thread, at the end; so are the disks at a region's edge, which list disks of another one. Which tile
// an event happened with depends on the threads, the event does not.
class ExactSweep {
 public:
  ExactSweep(ExactField& field, ExactLists& lists, const Executor& executor)
      : field_(field), lists_(lists), executor_(executor) {}

  // Is the sweep to have tiles for so many disks? And how many disks each, in build(): 0, none.
  bool has_tiles(std::size_t disks) const { return tiles_allowed_ && disks > executor_.grain(alone_below); }
  std::size_t disks_per_tile(std::size_t disks) const { return has_tiles(disks) ? executor_.grain(tile_disks) : 0; }
  // Of the roam, after which a disk is to be listed anew: where there are tiles, none whose motion is unknown may go
  // the whole way within a slice.
  double range_share(std::size_t disks) const { return has_tiles(disks) ? tiled_share : 1.0; }

  // Without tiles any number of disks runs alone: slower, but nothing is taken for granted of their speeds. Lists have
  // to be built anew after a change.
  void allow_tiles(bool allowed) { tiles_allowed_ = allowed; }
  bool tiles_allowed() const { return tiles_allowed_; }

  // A window begins; listed: the lists are new.
  void begin_window(bool listed);

  // Time that a slice may last, field.bound being set.
  double longest_slice() const;

  // Runs the slice, with about `expected` events. Unless it is done, nothing of the window counts. Inelastic collapse:
  // throws PhysicsError, or in tiles is `crowded`.
  SliceEnd run(double start, double end, double expected, double window_start);
  // Without tiles: the event that tells that the window is crowded, the reference's.
  const EventMark& crowding() const { return *rest_.crowded; }

  // Of the window so far.
  ImpactTally tally() const;
  Count events() const;
  bool any_gone() const;
  template <class Read>
  void read_logs(Read&& read) const {
    for (const Region& region : regions_) read(region.part.log);
    read(rest_.log);
  }
  // Disks listed anew since the lists were built.
  Count listed_anew() const { return listed_anew_; }

 private:
  // The most disks that run alone, and disks a tile: paths and lists fit in a processor's own caches.
  static constexpr std::size_t alone_below = 16384;
  static constexpr std::size_t tile_disks = 8192;
  static constexpr double tiled_share = 0.85;

  // Tiles [first, last), neighbours in memory.
  struct Region {
    std::uint32_t first = 0, last = 0;
    ExactPart part;
    std::vector<std::uint32_t> edge;       // disks at_edge
    std::vector<std::uint32_t> left_over;  // numbers of doubts that no tile of the region can settle
  };

  bool tiled() const { return has_tiles(field_.flight.size()); }
  void run_alone(double expected);
  void run_tiles(double expected);
  void lay_out_regions();
  void mark_edges(Region& region);
  void mark_borders(Region& region);
  void sweep_region(Region& region, double expected);
  void sweep_tile(Region& region, ExactEvents& events, std::uint32_t tile, double expected);
  void run_rest(double expected);
  SliceEnd end_of_slice() const;

  ExactField& field_;
  ExactLists& lists_;
  const Executor& executor_;
  std::vector<Region> regions_;
  std::vector<std::vector<std::uint32_t>> handed_on_;  // to each tile: numbers of doubts
  ExactPart rest_;                                     // everything where there are no tiles
  Count listed_anew_ = 0;
  bool tiles_allowed_ = true;
};

}  // namespace carom
