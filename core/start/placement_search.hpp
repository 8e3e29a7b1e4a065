// Random sequential addition, trial by trial: what the plain search of placement.cpp and the parallel one share.
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

// Where a centre may lie: r off walls and sinks, anywhere along a periodic axis; r within the edge of a region.
struct PlacementRoom {
  struct Axis {
    double low = 0.0, high = 0.0;
    bool holds(double c) const { return c >= low && c <= high; }
    double at(double u) const { return std::min(high, low + (high - low) * u); }
  };
  Axis across, up;
  double circle2 = -1.0;  // square of the largest distance from `middle`; negative: the region is no circle
  Vec2 middle{};
  bool holds(Vec2 p) const {
    if (!across.holds(p.x) || !up.holds(p.y)) return false;
    if (circle2 < 0.0) return true;
    const double x = p.x - middle.x;
    const double y = p.y - middle.y;
    return x * x + y * y <= circle2;
  }
};
// region: null where the whole box is one.
PlacementRoom placement_room(const Domain& box, double radius, const StartRegion* region = nullptr);

// The random numbers of one trial, from (seed, Stream::position, id, trial) alone.
struct TrialDraw {
  TwoUniforms place;
  double voxel = 0.0;  // which one of a list; only drawn where there is a list
};
TrialDraw draw_trial(std::uint64_t seed, std::uint32_t id, std::uint64_t trial, bool listed);

// The point of a trial: uniform over the room, or over the listed voxels, where list is no null pointer. Such a point
// may lie outside the room.
Vec2 trial_point(const Domain& box, const PlacementRoom& room, const VoxelList* list, const TrialDraw& draw);

// Does it pay to know the open cells after so many trials in vain for so many disks?
inline bool trials_are_many(std::uint64_t trials, std::uint64_t disks) {
  constexpr std::uint64_t many = 4;
  return trials > many * disks + 1000;
}

// A search through one class of members, whose radii differ by less than a factor of two. What it knows of the free
// places grows with need: nothing; which cells of a fixed grid are open; a list of voxels, refined now and then.
struct PlacementSearch {
  const Scene& scene;
  Disks& disks;
  PlacementGrid& grid;
  const std::vector<std::uint32_t>& members;  // all, large ones first
  const StartRegion* region = nullptr;        // of all members; null: the box
  std::uint64_t most = 0;                     // trials that the search may cost
  std::size_t begin = 0, end = 0;             // of the class, in members
  std::optional<OpenCells> cells;             // made once trials become many
  std::optional<VoxelList> list;              // takes their place when few are open
  std::uint64_t trials = 0;                   // so far, all disks
  std::uint64_t trials_before = 0;            // of them, by earlier classes
  std::uint64_t trials_of_one = 0;            // for the disk at hand
  std::uint64_t in_vain = 0;                  // trials since the list was made or refined

  // Goes on to the next class; false after the last.
  bool next_class();

  // Is there something to learn about free places before member k is placed? learn() does so, and may leave more to do.
  bool lesson_due(std::size_t k) const;
  void learn();

  // The last part of learn() in pieces, for many threads: learn() does without if there is no list to refine.
  bool refine_due() const { return list && in_vain > list->patience(); }
  void refine(std::vector<Voxel> survivors);
  // The survivors are in place already (VoxelList::put), and there are so many of them.
  void refine_to(std::size_t size);

  // Tries points for member k until one is free. Throws InputError when there is no room, or the trials run out.
  void place_one(std::size_t k);

  // `trials_in_vain` trials failed; count them.
  void count(std::uint64_t trials_in_vain);

  // Disk i is at (x, y) from now on.
  void settle(std::uint32_t i, double x, double y);

  [[noreturn]] void fail_jammed(std::size_t k) const;
};

// Trials of one disk before it is given up, and those after which the list may be refined for it alone.
inline constexpr std::uint64_t most_trials_of_one = 200'000;
inline constexpr std::uint64_t trials_between_lessons = 20'000;
// Trials that a search for so many may cost in all.
std::uint64_t most_trials(std::size_t members);

PlacementSearch make_placement_search(const Scene& scene, Disks& disks, PlacementGrid& grid,
                                      std::vector<std::uint32_t>& members);

}  // namespace carom
