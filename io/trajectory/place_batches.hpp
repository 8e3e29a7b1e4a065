// The disks that a trajectory shows in order of their places (disk_selection.hpp), batch after batch, whichever pieces
// they come in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/disks/disks_in_pieces.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Places first to first + count - 1, with the storage index at each, or no_disk; disk_at may continue behind them.
struct PlaceBatch {
  const Disks& disks;
  const std::vector<std::uint32_t>& disk_at;
  std::size_t first = 0, count = 0;
};

// The places of one frame's disks, which are visited once for each quantity.
class FramePlaces {
 public:
  // All arguments outlive this. chunk: number of places that are written together.
  FramePlaces(const Selection& select, const DisksInPieces& disks, std::size_t chunk)
      : select_(select), disks_(disks), chunk_(chunk) {}

  // The number of places up to the last one with a disk.
  std::size_t count() const;

  // Calls use() for all of these places, in order. Batches consist of whole chunks, except the last; disks that come in
  // one piece form one batch, others batches of some ten thousand.
  void visit(const std::function<void(const PlaceBatch&)>& use);

 private:
  const Selection& select_;
  const DisksInPieces& disks_;
  std::size_t chunk_;
  std::vector<std::uint32_t> disk_at_;  // if disks come in one piece, after the first visit
};

}  // namespace carom
