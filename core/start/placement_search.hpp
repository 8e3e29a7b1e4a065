// Random sequential addition, trial by trial: the part that the serial search of placement.cpp and the parallel one
// share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"
#include "core/start/open_cells.hpp"
#include "core/start/placement_grid.hpp"
#include "core/start/voxel_list.hpp"

namespace carom {

// The room of a centre: a radius away from walls, sinks and the edge of a region; anywhere along a periodic axis.
struct PlacementRoom {
  struct Axis {
    double low = 0.0, high = 0.0;
    bool holds(double c) const { return c >= low && c <= high; }
    double at(double u) const { return std::min(high, low + (high - low) * u); }
  };
  Axis across, up;
  double circle2 = -1.0;  // squared largest distance from `middle`; negative: the region is not a circle
  Vec2 middle{};
  bool holds(Vec2 p) const {
    if (!across.holds(p.x) || !up.holds(p.y)) return false;
    if (circle2 < 0.0) return true;
    const double x = p.x - middle.x;
    const double y = p.y - middle.y;
    return x * x + y * y <= circle2;
  }
};
// region: null for the whole box.
PlacementRoom placement_room(const Domain& box, double radius, const StartRegion* region = nullptr);

// The random numbers of one trial, from (seed, Stream::position, id, trial) alone.
struct TrialDraw {
  TwoUniforms place;
  double voxel = 0.0;  // selects a voxel of the list; drawn only if there is a list
};
TrialDraw draw_trial(std::uint64_t seed, std::uint32_t id, std::uint64_t trial, bool listed);

// The point of a trial: uniform over the room, or over the voxels of list if that is not null. Points of voxels may lie
// outside the room.
Vec2 trial_point(const Domain& box, const PlacementRoom& room, const VoxelList* list, const TrialDraw& draw);

// Have there been so many rejected trials that it pays to make OpenCells?
inline bool trials_are_many(std::uint64_t trials, std::uint64_t disks) {
  constexpr std::uint64_t many = 4;
  return trials > many * disks + 1000;
}

// The search for places of one class of members, whose radii differ by less than a factor of two. It keeps track of
// free places only as far as needed: at first not at all, then by the open cells of a fixed grid, then by a list of
// voxels, which is refined from time to time.
struct PlacementSearch {
  const Scene& scene;
  Disks& disks;
  PlacementGrid& grid;
  const std::vector<std::uint32_t>& members;  // all, large ones first
  const StartRegion* region = nullptr;        // of all members; null: the box
  std::uint64_t most = 0;                     // most trials of the search
  std::size_t begin = 0, end = 0;             // of the class, in members
  std::optional<OpenCells> cells;             // made once trials become many
  std::optional<VoxelList> list;              // replaces them when few are open
  std::uint64_t trials = 0;                   // so far, for all disks
  std::uint64_t trials_before = 0;            // those of earlier classes
  std::uint64_t trials_of_one = 0;            // for the present disk
  std::uint64_t in_vain = 0;                  // trials since the list was made or refined

  // Goes on to the next class; false after the last.
  bool next_class();

  // Is there something to learn about free places before member k is placed? learn() does so, and may leave more to do.
  bool lesson_due(std::size_t k) const;
  void learn();

  // For many threads: the refinement of the list in pieces, in place of learn(), if refine_due().
  bool refine_due() const { return list && in_vain > list->patience(); }
  void refine(std::vector<Voxel> survivors);
  // The same if the survivors, `size` of them, are in place already (VoxelList::put).
  void refine_to(std::size_t size);

  // Tries points for member k until one is free. Throws InputError when there is no room, or the trials run out.
  void place_one(std::size_t k);

  // Counts rejected trials.
  void count(std::uint64_t trials_in_vain);

  // Places disk i at (x, y).
  void settle(std::uint32_t i, double x, double y);

  [[noreturn]] void fail_jammed(std::size_t k) const;
};

// Most trials of one disk, and the number of trials after which the list may be refined for it alone.
inline constexpr std::uint64_t most_trials_of_one = 200'000;
inline constexpr std::uint64_t trials_between_lessons = 20'000;
// Most trials of a search for this number of disks.
std::uint64_t most_trials(std::size_t members);

PlacementSearch make_placement_search(const Scene& scene, Disks& disks, PlacementGrid& grid,
                                      std::vector<std::uint32_t>& members);

}  // namespace carom
