// Where disks that ranks place at random may still find room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/disks/domain.hpp"
#include "core/start/open_cells.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/voxel_list.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/slabs/placement_order.hpp"

namespace carom {

// A disk's place, and the trials in vain before it was found.
struct TrialPlace {
  Vec2 at;
  std::uint64_t trial = 0;
};

// What PlacementSearch (core/start/placement_search.hpp) learns of the box for one class of disks, at the same moments:
// nothing, which cells are open, a list of voxels. Each rank learns it of its own rows; what they tell each other are
// numbers of cells and of voxels. Whatever is returned is the same on all ranks.
class OpenPlaces {
 public:
  // largest_radius: of any disk; length. most_trials: in vain, of all disks together. disks: those near this rank's
  // rows, which the grid holds. known: this rank's heights; the rows of all ranks are all of the box.
  OpenPlaces(const Domain& box, const SizeClass& of, double largest_radius, std::uint64_t most_trials,
             const KnownHeights& known, const Disks& disks, const PlacementGrid& grid, Ranks& ranks)
      : box_(box),
        class_(of),
        tallest_tile_(tallest_tile(largest_radius)),
        most_trials_(most_trials),
        known_(known),
        disks_(disks),
        grid_(grid),
        ranks_(ranks) {}

  // Is there something to learn after so many disks of the class?
  bool lesson_due(std::size_t placed) const;
  // Collective. The grid has all disks that are placed and near. False where its rows reach further than this is for.
  bool learn();

  // How many disks there are up to the next lesson, one at least, if they take so many trials each. Before there is a
  // list, that is not foreseen.
  std::size_t disks_before_lesson(const std::vector<std::uint64_t>& trials) const;

  // Voxels, the same whoever has them; none where there is no list yet.
  const VoxelList* list() const { return list_ ? &*list_ : nullptr; }

  // Counts what a batch of disks costs and closes, in order, up to the first before which a lesson is due; returns how
  // many that are, one at least, or 0 where the trials run out. placed: those of the class before the batch.
  // Collective.
  std::size_t take_in(std::size_t placed, const std::vector<DiskToPlace>& disks, const std::vector<TrialPlace>& places);

  // How far a disk may be from a rank's heights and still close cells of its rows, or be in the way of a disk there;
  // length. largest_radius: of any disk.
  static double reach(double largest_radius) { return 2.0 * largest_radius + tallest_tile(largest_radius); }
  // In vain, so far.
  std::uint64_t trials() const { return trials_; }

 private:
  static double tallest_tile(double radius) { return 2.0 * radius; }
  bool make_cells();
  void make_list();
  void share_list();
  std::vector<std::int64_t> close(const std::vector<DiskToPlace>& disks, const std::vector<TrialPlace>& places);

  Domain box_;
  SizeClass class_;
  double tallest_tile_;  // length
  std::uint64_t most_trials_;
  KnownHeights known_;
  const Disks& disks_;
  const PlacementGrid& grid_;
  Ranks& ranks_;
  std::optional<OpenCells> cells_;  // made once trials become many
  std::optional<VoxelList> list_;   // takes their place when few are open
  std::size_t open_ = 0;            // cells, of all ranks
  bool closed_ahead_ = false;       // do cells_ know disks that are not placed?
  std::uint64_t trials_ = 0;        // in vain
  std::uint64_t in_vain_ = 0;       // since the list was made or refined
};

}  // namespace carom
