// The last free places of a random start: small cells (voxels) that are not ruled out, halved in size as they become
// few.
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

// One cell of the grid of a VoxelList.
struct Voxel {
  std::uint32_t column, row;
};

// Every place that the centre of a disk of radius `smallest` or more can still have lies in one of the listed voxels.
// So accepted points drawn from voxels have the distribution of accepted points drawn from the whole box. Near jamming,
// free places are far smaller than any fixed cell; voxels that are halved again and again keep the number of trials for
// each disk at a few (Wang, Int. J. Mod. Phys. C 5, 707 (1994); Zhang and Torquato, Phys. Rev. E 88, 053312 (2013)).
class VoxelList {
 public:
  // A tile is a square of so many by so many voxels of the first grid; its voxels share one search for near disks.
  static constexpr std::uint32_t tile = 4;

  // A grid of columns x rows over the box, with its open cells, preferably tile by tile. disks: number of disks to be
  // placed; it bounds the memory, 8 bytes for each voxel.
  VoxelList(const Domain& box, double smallest, std::size_t disks, std::size_t columns, std::size_t rows,
            std::vector<Voxel> open, const StartRegion* region = nullptr);

  // Number of voxels held. A new or changed list holds all of its voxels.
  std::size_t size() const { return list_.size(); }
  bool empty() const { return list_.empty(); }

  // Makes this a part of a list of `all` voxels that several ranks share: `before` voxels are in earlier parts.
  void be_part(std::size_t before, std::size_t all) {
    before_ = before;
    all_ = all;
  }
  std::size_t all() const { return all_; }
  // Is this voxel held?
  bool has(double which) const { return entry_of(which) - before_ < list_.size(); }

  // The number of rejected trials after which refining saves more than it costs.
  std::uint64_t patience() const { return all_ / 4 + 256; }

  // Is the point in one of the voxels? Reads the whole list.
  bool holds(Vec2 point) const;

  // A point uniform in a voxel. Precondition: the voxel is held.
  Vec2 point(TwoUniforms in_voxel, double which) const;

  // Prefetches the memory that point will read.
  void prefetch(double which) const { __builtin_prefetch(&list_[entry_of(which) - before_]); }

  // What remains of voxels [begin, end), in order: those that no disk of the grid rules out, or their remaining
  // quarters if the list is to be halved().
  std::vector<Voxel> survivors(const PlacementGrid& grid, std::size_t begin, std::size_t end) const;

  // Replaces the list by all survivors, in order.
  void replace(std::vector<Voxel> survivors);

  // Do survivors have half the size? If not, there are no more of them than voxels.
  bool halved() const;
  // As replace, in parts and without a second list, for a list that is not to be halved: writes survivors over the
  // voxels from `first` on, and returns their end, where the list ends for now. Precondition: they are survivors of
  // voxels before some k >= first + their number.
  std::size_t put(std::size_t first, const std::vector<Voxel>& survivors);
  void end_at(std::size_t size) {
    list_.resize(size);
    be_part(0, size);
  }

 private:
  bool outside(double x, double y, double half_x, double half_y) const;
  // Index among all voxels of the list.
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
