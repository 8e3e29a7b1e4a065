// The limits of validity of each method: figures to watch, their bounds, and one warning for each, with the figure and
// the remedy. Both engines note the same figures, so they give the same warnings. The motion of disks does not depend
// on it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/overlap.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Overlap of two disks after a step, over the sum of their radii: what a pile may have.
inline constexpr double largest_overlap = 0.02;
// The bound for the overlap of two disks before a step, and of a disk and a wall after it: disks move by a few per cent
// in a step, and the next step removes such overlaps.
inline constexpr double largest_overlap_before = 0.1;
// The bound for a disk and a wall in the exact method. Rounding is far below; a larger overlap means that a contact was
// missed.
inline constexpr double largest_exact_overlap = 1e-6;
// Share of inaccurate collisions: resolved a step late (pairwise), at the same moment as another of the same disk
// (rollback, F2 of docs/original.md), made elastic by the TC model (exact). In gases of packing fraction 0.3 to 0.88
// with this share, the collision rate was wrong by about 1 % (pairwise, rollback), the dissipation by about 5 % (TC).
inline constexpr double largest_inaccurate_share = 0.05;
// Share of late bounces off walls and obstacles in time stepping. A disk that crosses the gap between two walls more
// than once in a step loses about two bounces for each late one (scenes/stability/closing_walls.toml).
inline constexpr double largest_late_share_at_walls = 0.01;
// Shares are judged only above this number of inaccurate collisions.
inline constexpr Count least_inaccurate = 10;
// Least mean advance of rollback frames, in dt, over frames_watched frames: below this, time nearly stands still (F1).
inline constexpr double least_advance = 0.1;
inline constexpr Count frames_watched = 1000;
// Least radius over the size of the box. Positions are rounded to 1e-16 of the box, which smaller radii would notice.
inline constexpr double least_radius_share = 1e-9;
// Least displacement of the fastest disk in a step, in units of the rounding of positions: below it, rounding is more
// than a thousandth of the motion.
inline constexpr double least_step_roundings = 1e3;
// Largest root mean square displacement in a Brownian interval, over the smallest radius.
inline constexpr double largest_brownian_step = 0.5;

// Largest share of a source's disks that may wait for room at the end of a run: where disks are dense, some always
// wait.
inline constexpr double most_waiting = 0.05;

// The errors of a step, or of a part of it.
struct StepFigures {
  Overlap left{};                 // deepest overlap of two disks after pushing apart
  Overlap before{};               // deepest overlap of two disks in contact when the step began
  Overlap wall{};                 // deepest overlap of a disk and a wall, after pushing
  Count inaccurate = 0;           // collisions, see largest_inaccurate_share
  Count inaccurate_at_walls = 0;  // time stepping: late bounces off walls and obstacles

  void add(const StepFigures& other) {
    left.raise_to(other.left);
    before.raise_to(other.before);
    wall.raise_to(other.wall);
    inaccurate += other.inaccurate;
    inaccurate_at_walls += other.inaccurate_at_walls;
  }

  // Adds a later round of the same step, whose overlaps replace those left by the earlier one.
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
  // To be called if the step that starts in this state is split into parts. Of state, only state.validity changes.
  void note_split(State& state, double dt, Count parts);

  // To be called when a step, frame or window has ended in this state. Of state, only state.validity changes.
  void note_step(const Scene& scene, const StepFigures& figures, State& state);

  // The warnings since the last call. Each kind is given once in a run, with the first figure beyond its bound. Counts
  // and given warnings are in the state, so checkpoints keep both.
  std::vector<std::string> take_warnings();

 private:
  void note_overlap(const Scene& scene, const StepFigures& figures, State& state);
  void note_inaccurate(const Scene& scene, Count count, State& state);
  void note_late_at_walls(const Scene& scene, Count count, State& state);
  void note_advance(const Scene& scene, State& state);

  std::vector<std::string> warnings_;
};

// The warnings of a run that has come to this state, in order of kind, each with the worst figure.
std::vector<std::string> validity_warnings_so_far(const Scene& scene, const State& state);

// Does the exact method check overlaps with walls at every window's end? Only if paths are curved, walls move or there
// are obstacles; on straight paths to the sides nothing but rounding could be found.
bool walls_are_watched(const Scene& scene);

// Those of them that are about a single moment, not about a share of all collisions.
std::vector<std::string> worst_moment_warnings(const Scene& scene, const State& state);

// Throws PhysicsError if a moving wall has pressed disks into each other, or into a wall, by more than crushed_overlap:
// they have no room left. Called before and after each step, so that a resumed run refuses such a state, too.
inline constexpr double crushed_overlap = 0.25;
void check_crushed(const Scene& scene, const State& state);

// Warnings before the first step, one line each: rounding of positions against radii or displacements, too long
// Brownian intervals, too long steps for a vibrating wall. smallest_radius, fastest (speed): of the disks at the start;
// 0 if there are none, or none moves.
std::vector<std::string> validity_warnings_at_start(const Scene& scene, double smallest_radius, double fastest = 0.0);

// For the end of a run: a line for each source of whose disks more than the share most_waiting still wait for room, or
// that has emitted none. when: the beginning of the line, before the time.
std::vector<std::string> waiting_warnings(const Scene& scene, const State& state,
                                          std::string_view when = "at the end,");

}  // namespace carom
