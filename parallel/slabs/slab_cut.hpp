// Slabs of the box, one above the other, one for each rank.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// bounds[r] to bounds[r + 1] is the slab of rank r; bounds.front() is 0, bounds.back() the box's height.
struct SlabCut {
  std::vector<double> bounds;  // length

  int ranks() const { return static_cast<int>(bounds.size()) - 1; }
  double low(int rank) const { return bounds[static_cast<std::size_t>(rank)]; }
  double high(int rank) const { return bounds[static_cast<std::size_t>(rank) + 1]; }
  double thinnest() const;
  // The rank whose slab has a centre at this height; below the box the first one, above it the last.
  int rank_at(double y) const;
  // True only if that is this rank; a fast test, which is false outside the box.
  bool is_between_bounds(int rank, double y) const { return y >= low(rank) && y < high(rank); }
};

// An engine whose disks are in slabs, except for their motion since they were distributed.
class InSlabs {
 public:
  InSlabs() = default;
  InSlabs(const InSlabs&) = delete;
  InSlabs& operator=(const InSlabs&) = delete;
  virtual ~InSlabs() = default;
  // The same on all ranks; null while the disks are not in slabs.
  virtual const SlabCut* slab_cut() const = 0;
  // The number of this rank's disks, without making a state of them.
  virtual Count own_disks() const = 0;
  // The number of other ranks' disks that this one had as ghosts in the last step; 0 while the disks are not in slabs.
  virtual Count ghosts() const = 0;
};

// The least thickness of a slab, in largest radii. With it disks of the slabs on either side of a slab never touch, as
// far as any disk may leave its own slab before it moves to the next rank.
inline constexpr double least_thickness = 4.0;

// Slabs with about the same number of disks each, no thinner than least (length). Preconditions: ranks >= 1, ranks *
// least <= height.
SlabCut cut_into_slabs(const Domain& box, const Disks& disks, int ranks, double least);

// The same from the numbers of disks in rows of equal height, from the bottom of the box up; slabs may be of any
// thickness. Precondition: there are rows.
SlabCut cut_by_rows(const Domain& box, const std::vector<std::int64_t>& disks_of_row, int ranks);

// Moves bounds until no slab is thinner. Precondition: as above.
void keep_thick(SlabCut& cut, double least);

// The largest distance that a disk may leave its slab by so that all disks that touch it are still at most one slab
// further; length.
inline double room_beyond(const SlabCut& cut, double largest_radius) {
  return 0.5 * (cut.thinnest() - 2.0 * largest_radius);
}

}  // namespace carom
