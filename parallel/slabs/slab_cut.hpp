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
  // The rank that has a centre at this height; below the box the first one, above it the last.
  int rank_at(double y) const;
  // True only if that is this rank, and quickly; not of what lies outside the box.
  bool is_between_bounds(int rank, double y) const { return y >= low(rank) && y < high(rank); }
};

// An engine whose disks are in slabs, but for what they have moved since they were shared out.
class InSlabs {
 public:
  InSlabs() = default;
  InSlabs(const InSlabs&) = delete;
  InSlabs& operator=(const InSlabs&) = delete;
  virtual ~InSlabs() = default;
  // The same on all ranks; null while the disks are not in slabs.
  virtual const SlabCut* slab_cut() const = 0;
  // This rank's disks; no state is made of them.
  virtual Count own_disks() const = 0;
  // Disks of other ranks that this one had beside its own in the last step; 0 while the disks are not in slabs.
  virtual Count ghosts() const = 0;
};

// A slab has to be so much thicker than the largest radius: disks of the slabs on either side of it never touch, as far
// as any may leave its own slab before it goes to the next rank.
inline constexpr double least_thickness = 4.0;  // radii

// Slabs with about as many disks each, no thinner than least (length). Precondition: ranks >= 1, ranks * least <=
// height.
SlabCut cut_into_slabs(const Domain& box, const Disks& disks, int ranks, double least);

// The same from how many disks there are in rows that divide the box's height evenly, in order of heights; slabs may be
// as thin as they come. Precondition: there are rows.
SlabCut cut_by_rows(const Domain& box, const std::vector<std::int64_t>& disks_of_row, int ranks);

// Moves bounds until no slab is thinner. Precondition: as above.
void keep_thick(SlabCut& cut, double least);

// How far a disk may leave its slab, and others still find all that touch it one slab further; length.
inline double room_beyond(const SlabCut& cut, double largest_radius) {
  return 0.5 * (cut.thinnest() - 2.0 * largest_radius);
}

}  // namespace carom
