// The last free places of a random start: small cells (voxels) that are not yet ruled out, halved as they fill up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/random.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"
#include "core/start/placement_grid.hpp"

namespace carom {

// One cell of a grid over the box; which grid, the list knows.
struct Voxel {
  std::uint32_t column, row;
};

// Every centre that a disk of radius smallest or more may still have lies in one of the listed voxels, so points drawn
// from them have, once accepted, the distribution of points drawn from the whole box. Near jamming, free places are far
// smaller than any fixed cell: voxels that are halved again and again keep the trials a disk at a few (Wang, Int. J.
// Mod. Phys. C 5, 707 (1994); Zhang and Torquato, Phys. Rev. E 88, 053312 (2013)).
class VoxelList {
 public:
  // Voxels in a tile of so many by so many of the first grid share a look at their neighbours.
  static constexpr std::uint32_t tile = 4;

  // A grid of columns x rows over the box, and those of its cells that are open, best tile by tile. disks is the number
  // that the list is for: it bounds the memory, 8 bytes a voxel.
  VoxelList(const Domain& box, double smallest, std::size_t disks, std::size_t columns, std::size_t rows,
            std::vector<Voxel> open, const StartRegion* region = nullptr);

  // Of the voxels that are here. As a list is made or changed, they are all there are.
  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }

  // Some of a list of so many that several share: those that so many are before.
  void be_part(std::size_t before, std::size_t all) {
    before_ = before;
    all_ = all;
  }
  std::size_t all() const { return all_; }
  // Is the voxel here?
  bool has(double which) const { return entry_of(which) - before_ < list_.size(); }

  // The least trials in vain after which refining costs less than it saves.
  std::uint64_t patience() const { return all_ / 4 + 256; }

  // Is the point in one of the voxels? Reads the whole list.
  bool holds(Vec2 point) const;

  // A point uniform in a voxel. Precondition: it is here.
  Vec2 point(TwoUniforms in_voxel, double which) const;

  // Asks for the memory that point is about to read.
  void prefetch(double which) const { __builtin_prefetch(&list_[entry_of(which) - before_]); }

  // What is left of the voxels begin to end - 1 of the list, in their order: those that no disk of the grid rules out,
  // whole, or the quarters of them if the list is to be halved().
  std::vector<Voxel> survivors(const PlacementGrid& grid, std::size_t begin, std::size_t end) const;

  // The new list: all survivors, in order.
  void replace(std::vector<Voxel> survivors);

  // Do the survivors of this list have half the size? If not, they are no more than the voxels that they are made from.
  bool halved() const;
  // The same as replace, part by part and without a second list, of a list that is not to be halved: puts survivors of
  // voxels up to some k >= first + their number in place of those from `first` on, and returns where they end;
  // afterwards the list ends there.
  std::size_t put(std::size_t first, const std::vector<Voxel>& survivors);
  void end_at(std::size_t size) {
    list_.resize(size);
    be_part(0, size);
  }

 private:
  bool outside(double x, double y, double half_x, double half_y) const;
  // Among all.
  std::size_t entry_of(double which) const {
    return std::min(static_cast<std::size_t>(which * static_cast<double>(all_)), all_ - 1);
  }

  Domain box_;
  const StartRegion* region_;  // see OpenCells
  double smallest_;
  std::size_t disks_;
  std::uint64_t columns_, rows_;
  double size_x_, size_y_;     // of a voxel, length
  std::uint32_t tile_ = tile;  // voxels along a side of a tile
  std::vector<Voxel> list_;
  std::size_t before_ = 0, all_ = 0;
};

}  // namespace carom
