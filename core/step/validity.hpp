// When a run leaves what its method can do right: the figures that tell, their bounds, and one warning for each, with
// the figure and the remedy. Both engines feed it the same figures, so they warn alike. It only counts: no disk
// depends on it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/overlap.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Overlap left to two disks (or a disk and a wall) after a step, over the sum of radii: what a pile may have.
inline constexpr double largest_overlap = 0.02;
// The same of two disks that impacts of the step before have brought together, and of a disk and a wall: a few per cent
// are what disks move in a step, and the next one sees to them.
inline constexpr double largest_overlap_before = 0.1;
// An exact method leaves rounding alone between a disk and a wall. More means that a contact was missed.
inline constexpr double largest_exact_overlap = 1e-6;
// Share of the inaccurate collisions: seen a step late (pairwise), bounced together with another of the same disk
// (rollback, F2 of docs/original.md), made elastic by the TC model (exact). Measured on gases of packing fraction 0.3
// to 0.88, with such a share the collision rate (for the TC model, the dissipation) is off by about 1 % (pairwise,
// rollback) or 5 % (TC).
inline constexpr double largest_inaccurate_share = 0.05;
// Share of the bounces off walls and obstacles that time stepping sees late. A disk that crosses the room between two
// walls more than once in a step loses about two bounces for each that is late (scenes/stability/closing_walls.toml).
inline constexpr double largest_late_share_at_walls = 0.01;
// So many of them may happen before a share means anything.
inline constexpr Count least_inaccurate = 10;
// Time that a frame of rollback advances, in dt, averaged over the frames watched: below this time all but stands (F1).
inline constexpr double least_advance = 0.1;
inline constexpr Count frames_watched = 1000;
// Places are known to the size of the box times 1e-16. Radii below this share of it see that.
inline constexpr double least_radius_share = 1e-9;
// Steps that move even the fastest disk by less than so many times the rounding of its place are lost in it, by a
// thousandth and more.
inline constexpr double least_step_roundings = 1e3;
// Root mean square displacement of a Brownian interval, over the smallest radius.
inline constexpr double largest_brownian_step = 0.5;

// Share of the disks due from a source that may wait for room at the end of a run: some always do where disks are
// dense.
inline constexpr double most_waiting = 0.05;

// What a step (or a part of it) did that no exact motion does.
struct StepFigures {
  Overlap left{};                 // the deepest of two disks after pushing apart, or of disks that part
  Overlap before{};               // that two disks in contact had when the step began
  Overlap wall{};                 // of a disk and a wall, after pushing
  Count inaccurate = 0;           // collisions, see largest_inaccurate_share
  Count inaccurate_at_walls = 0;  // time stepping: bounces off walls and obstacles that are met late

  void add(const StepFigures& other) {
    left.raise_to(other.left);
    before.raise_to(other.before);
    wall.raise_to(other.wall);
    inaccurate += other.inaccurate;
    inaccurate_at_walls += other.inaccurate_at_walls;
  }

  // Goes on with a later round of the same step: what is left is what that one leaves.
  void go_on(const StepFigures& later) {
    left = later.left;
    wall = later.wall;
    before.raise_to(later.before);
    inaccurate += later.inaccurate;
    inaccurate_at_walls += later.inaccurate_at_walls;
  }
};

class Validity {
 public:
  // The step that starts in this state is longer than the safe one. Of state, only state.validity changes.
  void note_split(State& state, double dt, Count parts);

  // A step, frame or window has ended in this state. Of it, only state.validity changes.
  void note_step(const Scene& scene, const StepFigures& figures, State& state);

  // Those since the last call, one of each kind in a run: with what was seen first. What was counted, and that it was
  // told, is in the state: a checkpoint keeps both.
  std::vector<std::string> take_warnings();

 private:
  void note_overlap(const Scene& scene, const StepFigures& figures, State& state);
  void note_inaccurate(const Scene& scene, Count count, State& state);
  void note_late_at_walls(const Scene& scene, Count count, State& state);
  void note_advance(const Scene& scene, State& state);

  std::vector<std::string> warnings_;
};

// The same warnings for a run that has come to this state, in order of kind: with the worst that was seen.
std::vector<std::string> validity_warnings_so_far(const Scene& scene, const State& state);

// Is an exact method to look at walls at every window's end? Where paths are curved, walls move or anything stands in
// the box; along straight lines to the sides alone, rounding is all that can be seen.
bool walls_are_watched(const Scene& scene);

// Those of them that tell of one moment, the worst; not of a share that goes on with every step.
std::vector<std::string> worst_moment_warnings(const Scene& scene, const State& state);

// Throws PhysicsError where a wall that moves has pressed disks into each other by more than crushed_overlap, or into
// itself: it goes on, and they cannot. Asked before and after a step, so that a state that was left so stays refused,
// also by a run that is taken up again.
inline constexpr double crushed_overlap = 0.25;
void check_crushed(const Scene& scene, const State& state);

// What can be said before the first step: places too coarse for the radii or for the way of a step, Brownian intervals
// too long. One line each. smallest_radius, fastest (speed): of the disks at the start, 0 if there are none or none
// moves.
std::vector<std::string> validity_warnings_at_start(const Scene& scene, double smallest_radius, double fastest = 0.0);

// What a run at its end has to say of disks that still wait for room: a line for each source whose share of them is
// above most_waiting, or that never gave one. when: how the line begins, before the time.
std::vector<std::string> waiting_warnings(const Scene& scene, const State& state,
                                          std::string_view when = "at the end,");

}  // namespace carom
