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

// The box in which disks are placed. The ranks' slabs are those of another box, whose lower side is `up` below that of
// this box (length).
struct PlacementSite {
  const Scene& scene;
  Domain box;
  const SlabCut& cut;
  double up;
  Ranks& ranks;

  bool is_own(Vec2 p) const { return cut.rank_at(p.y + up) == ranks.rank(); }
};

// A trial's point follows from seed, id and trial, and, if few places are left, from a list of voxels of which each
// rank has a part. Only the rank in whose slab, or voxels, the point lies knows whether it is free of the disks placed
// before. The ranks exchange a bit a trial, and the points that not all of them know.
class PlacementTrials {
 public:
  // All arguments outlive this. grid: all disks placed before near this rank's own places.
  PlacementTrials(const PlacementSite& site, const OpenPlaces& places, const PlacementGrid& grid)
      : site_(site), places_(places), grid_(grid) {}

  // For each of these disks finds the first free trial from next[m] on, and stores it in next[m]. Returns how many of
  // the disks, from the first on, have one: a disk with trials_between_lessons failed trials has none. in_turn: the
  // disks are placed next, one after the other, so those that come after a lesson need no trial. Collective.
  std::size_t next_free(const std::vector<DiskToPlace>& disks, std::vector<std::uint64_t>& next, bool in_turn);

  // The places of free trials. Collective.
  std::vector<TrialPlace> places_of(const std::vector<DiskToPlace>& disks,
                                    const std::vector<std::uint64_t>& trials) const;

 private:
  struct Asked {
    std::size_t trial;  // number among those that are exchanged together
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
