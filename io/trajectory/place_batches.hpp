// The disks that a trajectory shows by their places (disk_selection.hpp), batch after batch, whatever pieces they come
// in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Of places first to first + count - 1: the storage index at each, or no_disk; disk_at may go on behind them.
struct PlaceBatch {
  const Disks& disks;
  const std::vector<std::uint32_t>& disk_at;
  std::size_t first = 0, count = 0;
};

// How many places there are up to the last that has a disk.
std::size_t count_places(const Selection& select, const DisksInPieces& disks);

// Calls use() for all of these places, in order. Batches are of whole chunks, but for the last; disks that come in one
// piece are one batch, of others there are some ten thousand in each.
void visit_places(const Selection& select, const DisksInPieces& disks, std::size_t chunk,
                  const std::function<void(const PlaceBatch&)>& use);

}  // namespace carom
