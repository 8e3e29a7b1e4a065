// How the exact engine finds and orders the events of a window. Results do not depend on it, only speed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "parallel/threads/executor.hpp"

namespace carom {

enum class EngineMode : std::uint8_t {
  all_pairs,     // every disk lists every other one; one event queue
  single_queue,  // neighbour lists with a skin; one event queue, on one thread
  tiled,         // neighbour lists with a skin; an event queue for each tile, on all threads
};

// The mode and what follows from it for the neighbour lists.
struct ListLayout {
  EngineMode mode = EngineMode::single_queue;
  std::size_t disks_per_tile = 0;  // tiled mode
  // Share of the skin that a disk may move through before it is relisted. Below 1 where there are tiles: a disk that is
  // pending or blocked must not cross the whole skin within a slice.
  double relist_share = 1.0;
};

// Up to so many disks all pairs are as fast as lists, and nothing has to be relisted in the long windows of few disks.
inline constexpr std::size_t all_pairs_up_to = 40;
// The most disks for which one queue, on one thread, is faster than tiles on one thread, and on so many that all are
// busy.
inline constexpr std::size_t single_queue_up_to = 131072;
inline constexpr std::size_t least_single_queue_up_to = 16384;
inline constexpr std::size_t disks_a_tile = 8192;
inline constexpr double tiled_relist_share = 0.85;

// The only place where the mode is chosen. tiles_allowed: false where a window is run again without tiles.
inline ListLayout choose_layout(std::size_t disks, bool tiles_allowed, const Executor& executor) {
  if (disks <= all_pairs_up_to) return {EngineMode::all_pairs, 0, 1.0};
  // Where work is cut into smaller blocks, tiles are wanted for fewer disks too.
  const bool is_cut = executor.grain(disks_a_tile) < disks_a_tile;
  const std::size_t shared = single_queue_up_to / static_cast<std::size_t>(executor.threads());
  const std::size_t single =
      is_cut ? executor.grain(least_single_queue_up_to) : std::max(shared, least_single_queue_up_to);
  if (!tiles_allowed || disks <= single) return {EngineMode::single_queue, 0, 1.0};
  return {EngineMode::tiled, executor.grain(disks_a_tile), tiled_relist_share};
}

}  // namespace carom
