// Where disks that ranks place at random may still have room.
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

// A disk's place, and the number of failed trials before it was found.
struct TrialPlace {
  Vec2 at;
  std::uint64_t trial = 0;
};

// What PlacementSearch (core/start/placement_search.hpp) learns of the box for one class of disks, at the same moments:
// first nothing, then the open cells, then a list of voxels. Each rank learns it for its own rows; ranks tell each
// other only numbers of cells and of voxels. All return values are the same on all ranks.
class OpenPlaces {
 public:
  // largest_radius: of any disk; length. most_trials: failed ones, of all disks together. disks: those near this rank's
  // rows, which the grid holds. known: this rank's heights; the rows of all ranks together make up the box.
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

  // Is a lesson due after this number of disks of the class?
  bool lesson_due(std::size_t placed) const;
  // Collective. The grid has all disks that are placed nearby. Returns false if its rows exceed what this is made for.
  bool learn();

  // The number of disks up to the next lesson, at least one, if they take these numbers of trials. It is not predicted
  // before there is a list.
  std::size_t disks_before_lesson(const std::vector<std::uint64_t>& trials) const;

  // The voxels, the same on all ranks, whichever has them; null if there is no list yet.
  const VoxelList* list() const { return list_ ? &*list_ : nullptr; }

  // Counts the trials of a batch of disks and the cells that they close, in order, up to the first disk before which a
  // lesson is due; returns the number of disks counted, at least one, or 0 if the trials run out. placed: disks of the
  // class before the batch. Collective.
  std::size_t take_in(std::size_t placed, const std::vector<DiskToPlace>& disks, const std::vector<TrialPlace>& places);

  // The largest distance of a disk from a rank's heights at which it still closes cells of its rows, or obstructs a
  // disk there; length. largest_radius: of any disk.
  static double reach(double largest_radius) { return 2.0 * largest_radius + tallest_tile(largest_radius); }
  // Failed trials so far.
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
  std::optional<OpenCells> cells_;  // made once there are many trials
  std::optional<VoxelList> list_;   // replaces the cells when few are open
  std::size_t open_ = 0;            // number of open cells, on all ranks
  bool closed_ahead_ = false;       // has cells_ been told of disks that are not placed?
  std::uint64_t trials_ = 0;        // failed ones
  std::uint64_t in_vain_ = 0;       // failed ones since the list was made or refined
};

}  // namespace carom
