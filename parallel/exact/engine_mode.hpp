// How the exact engine finds and orders the events of a window. Results do not depend on it, only speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/disks/domain.hpp"
#include "parallel/cells/tiled_grid.hpp"
#include "parallel/exact/listed_box.hpp"
#include "parallel/exact/most_listed.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

enum class EngineMode : std::uint8_t {
  all_pairs,     // every disk lists every other one; one event calendar
  single_queue,  // neighbour lists with a skin; one event calendar, on one thread
  regions,       // neighbour lists with a skin; an event calendar for each region of the box, on all threads
};

// The mode, and the parameters of the neighbour lists that follow from it.
struct ListLayout {
  EngineMode mode = EngineMode::single_queue;
  std::size_t disks_per_tile = 0;  // with regions
  std::size_t regions = 0;
  // The distance that a disk near a border between regions may move before it is relisted, over the skin; other disks
  // may move by the whole skin. Less than 1 with regions: a disk at a border is not relisted within a slice, and must
  // not leave its skin in it.
  double relist_share = 1.0;
  // Prefetch disks whose events come soon, since a cache does not hold all.
  bool looks_ahead = false;
  // The number of disks in the whole box, if a rank or a part has only some of them; 0: it has all.
  std::size_t disks_of_box = 0;
  // If disks_of_box is not 0: the disks are about in the rectangle between these two places; along an axis on which low
  // is not below high, anywhere in the box. Lengths.
  Vec2 low{}, high{};
  // If disks_of_box is not 0: the largest radius in the whole box; lists for disks hardly smaller can take larger ones.
  // Length.
  double largest_of_box = 0.0;
  // The growth of every radius that lists allow for; it reduces the skin by as much; length.
  double growth = 0.0;
};

// Up to this number of disks, listing all pairs is as fast as neighbour lists, and needs no relisting in the long
// windows of few disks.
inline constexpr std::size_t all_pairs_up_to = 40;
// Up to this number of disks one queue on one thread is as fast as regions on two threads; the second constant is used
// if work is cut into smaller blocks, as in tests.
inline constexpr std::size_t single_queue_up_to = 49152;
inline constexpr std::size_t single_queue_of_cut_work_up_to = 8192;
// The data of this number of disks, 200 bytes each, fit in the second-level cache.
inline constexpr std::size_t disks_in_cache = 16384;
// Disks of a tile are neighbours in memory; regions consist of whole layers of tiles.
inline constexpr std::size_t most_disks_a_tile = 8192;
inline constexpr std::size_t tiles_a_region = 16;
// relist_share with regions. The larger, the fewer relistings near borders; the smaller, the longer slices.
inline constexpr double region_relist_share = 0.75;
// relist_share on one of several ranks.
inline constexpr double rank_relist_share = 0.7;
// The least width of a region, in mean spacings: in a narrower one, the disks blocked from one border would meet those
// blocked from the other.
inline constexpr double least_region_width = 30.0;
// With more disks than this, memory that is not needed at present is freed.
inline constexpr std::size_t disks_of_much_memory = 65536;

// The number of regions of the least width along the box's longer side.
inline std::size_t most_regions(std::size_t disks, const Domain& box) {
  const double aspect = std::max(box.width / box.height, box.height / box.width);
  return static_cast<std::size_t>(std::sqrt(aspect * static_cast<double>(disks)) / least_region_width);
}

// The layout for all disks together; whether windows are run in parts is decided before (HaloWindows). regions_allowed:
// false if a window must be run again without regions.
inline ListLayout choose_layout(std::size_t disks, const Domain& box, bool regions_allowed, const Executor& executor) {
  if (disks <= all_pairs_up_to) return {.mode = EngineMode::all_pairs};
  if (!can_list_in(box)) {
    check_all_listed(disks);
    return {.mode = EngineMode::all_pairs};
  }
  // If work is cut into smaller blocks (tests), regions are used for fewer disks, too, and more than one of them on one
  // thread.
  const bool is_cut = executor.grain(single_queue_up_to) < single_queue_up_to;
  const std::size_t single = is_cut                    ? executor.grain(single_queue_of_cut_work_up_to)
                             : executor.threads() == 1 ? disks
                                                       : single_queue_up_to;
  const std::size_t wanted = std::max<std::size_t>(static_cast<std::size_t>(executor.threads()), 2);
  const std::size_t regions = is_cut ? wanted : std::min(wanted, most_regions(disks, box));
  // Regions cannot handle moving images.
  if (!regions_allowed || box.shear.acts() || disks <= single || regions < 2) {
    return {.mode = EngineMode::single_queue, .looks_ahead = disks > executor.grain(disks_in_cache)};
  }
  const std::size_t disks_a_tile = std::min(executor.grain(most_disks_a_tile), disks / (tiles_a_region * regions) + 1);
  return {.mode = EngineMode::regions,
          .disks_per_tile = disks_a_tile,
          .regions = regions,
          .relist_share = region_relist_share,
          .looks_ahead = disks / regions > executor.grain(disks_in_cache)};
}

// The layout for a part of the box and its halo, with this number of disks in both together: one calendar. low, high:
// as in ListLayout.
inline ListLayout layout_of_part(std::size_t disks, std::size_t disks_of_box, Vec2 low, Vec2 high) {
  ListLayout layout;
  layout.looks_ahead = disks > disks_in_cache;
  layout.regions = 1;
  layout.disks_of_box = disks_of_box;
  layout.low = low;
  layout.high = high;
  return layout;
}

// The layout for one of several ranks: one region, for its own disks and its ghosts, `disks` in all, between two
// heights. disks_of_box: of all ranks.
inline ListLayout layout_of_rank(std::size_t disks, std::size_t disks_of_box, double low, double high,
                                 const Executor& executor) {
  ListLayout layout;
  layout.mode = EngineMode::regions;
  const std::size_t tile = std::min(executor.grain(most_disks_a_tile), disks / tiles_a_region + 1);
  layout.disks_per_tile = even_tile(tile, disks_of_box);
  layout.regions = 1;
  layout.relist_share = rank_relist_share;
  layout.looks_ahead = disks > executor.grain(disks_in_cache);
  layout.disks_of_box = disks_of_box;
  layout.low.y = low;
  layout.high.y = high;
  return layout;
}

}  // namespace carom
