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

// The places of one frame's disks, which are visited once for each of their quantities.
class FramePlaces {
 public:
  // All outlive this. chunk: places that are written together.
  FramePlaces(const Selection& select, const DisksInPieces& disks, std::size_t chunk)
      : select_(select), disks_(disks), chunk_(chunk) {}

  // How many there are up to the last that has a disk.
  std::size_t count() const;

  // Calls use() for all of these places, in order. Batches are of whole chunks, but for the last; disks that come in
  // one piece are one batch, of others there are some ten thousand in each.
  void visit(const std::function<void(const PlaceBatch&)>& use);

 private:
  const Selection& select_;
  const DisksInPieces& disks_;
  std::size_t chunk_;
  std::vector<std::uint32_t> disk_at_;  // of disks that come in one piece, once they were visited
};

}  // namespace carom
