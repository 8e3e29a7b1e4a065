// The trials of disks that ranks place at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/placement_search.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/open_places.hpp"
#include "parallel/slabs/shared_bits.hpp"
#include "parallel/slabs/slab_cut.hpp"

namespace carom {

// A box in which disks are placed, whose ranks each have a slab of another one: its lower side lies `up` below that of
// the box (length).
struct PlacementSite {
  const Scene& scene;
  Domain box;
  const SlabCut& cut;
  double up;
  Ranks& ranks;

  bool is_own(Vec2 p) const { return cut.rank_at(p.y + up) == ranks.rank(); }
};

// A trial's point follows from seed, id and trial, and where few places are left from a list of voxels of which each
// rank has a part; whether it is free of the disks placed before knows the rank in whose slab, or voxels, it lies. What
// they tell each other is a bit a trial, and points that not all of them know.
class PlacementTrials {
 public:
  // All of it outlives this. grid: of all disks placed before that are near this rank's own places.
  PlacementTrials(const PlacementSite& site, const OpenPlaces& places, const PlacementGrid& grid)
      : site_(site), places_(places), grid_(grid) {}

  // For each of these disks, from trial next[m] on, the first that is free; next[m] becomes it. Returns how many of
  // them, from the first on, have one: a disk with trials_between_lessons in vain has none. in_turn: the disks are
  // placed next, one after the other, so that those that come after a lesson need none. Collective.
  std::size_t next_free(const std::vector<DiskToPlace>& disks, std::vector<std::uint64_t>& next, bool in_turn);

  // The places of trials that are free. Collective.
  std::vector<TrialPlace> places_of(const std::vector<DiskToPlace>& disks,
                                    const std::vector<std::uint64_t>& trials) const;

 private:
  struct Asked {
    std::size_t trial;  // of those that are asked about at once
    Vec2 point;
    double radius;
  };

  std::optional<Vec2> known_point(const DiskToPlace& disk, const PlacementRoom& room, std::uint64_t trial) const;
  void ask(std::size_t trial, Vec2 point, double radius);
  void answer();

  const PlacementSite& site_;
  const OpenPlaces& places_;
  const PlacementGrid& grid_;
  SharedBits free_;
  std::vector<Asked> asked_;
};

}  // namespace carom
