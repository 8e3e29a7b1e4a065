// The state of a run: the disks, the time and the counters. Nothing else changes during a run.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/obstacle.hpp"
#include "core/disks/overlap.hpp"
#include "core/disks/sink_counts.hpp"

namespace carom {

struct Counters {
  Count steps = 0;            // steps of dt (frames for rollback, windows for exact)
  Count collisions = 0;       // disk-disk
  Count wall_collisions = 0;  // disk-wall
  Count removed = 0;          // by sinks
  Count emitted = 0;          // by sources
  Count waiting = 0;          // due from a source, no room found yet
  double disk_time = 0.0;  // sum over disks of the time that each was in the box (time stepping: see count_step); time
  double disk_time_excess = 0.0;  // rounding error of that sum, > 0 if it is too large; time
  double virial = 0.0;            // sum over disk-disk collisions of |impulse| (r1 + r2); mass length^2 / time
  // Kinetic, potential and rotational energy that disks from sources, and changes by a program, have brought in.
  double emitted_energy = 0.0;
  double wall_impulse[4] = {0, 0, 0, 0};  // sum of |impulse| on each side (order of Side); mass length / time
  // Energy that each side has given to the disks: heat of a thermal side, work of a moving one.
  double side_energy[4] = {0, 0, 0, 0};
  double thermostat_heat = 0.0;  // energy that a thermostat has given to the disks
  // In a sheared box: the virial times nx ny, n from one centre to the other; and the work of the shear.
  double shear_virial = 0.0, shear_work = 0.0;
  // Energy and momentum (x, y) that moving inner walls have given to the disks.
  double wall_work = 0.0;
  double wall_push[2] = {0, 0};
};

struct SourceState {
  Count emitted = 0;  // by this source so far
};

// Force that a contact of a settling scene bore in the last step (core/physics/resting.hpp); id2 may be a wall.
struct ContactLoad {
  DiskId id1 = 0, id2 = 0;
  double force = 0.0;  // mass length / time^2, > 0
};

// For the detection of a run whose time no longer advances (core/step/rollback_frame.hpp, core/step/window_plan.hpp).
struct StallWatch {
  Count frames = 0;  // rollback: frames since `since`; exact: crowded windows in a row
  double since = 0.0;
};

// The worst value so far, and its time.
struct WorstOverlap {
  Overlap overlap;
  double time = 0.0;  // end of the step
};
struct WorstFigure {
  double figure = 0.0;
  double time = 0.0;  // of the step or frame
};

// Signs that the method is inaccurate, and which warnings have been given (core/step/validity.hpp). They do not change
// the motion of disks, but a run ends if disks are crushed.
struct ValidityCounts {
  Count inaccurate = 0;           // collisions
  Count inaccurate_at_walls = 0;  // time stepping: those with walls and obstacles, not counted in `inaccurate`
  Count frames = 0;               // of rollback, since `since`
  double since = 0.0;             // simulated time at which the frames that are watched begin
  bool split_told = false, overlap_told = false, inaccurate_told = false, slow_told = false;
  bool late_at_walls_told = false;
  WorstOverlap disks, wall;  // two disks; a disk and a wall
  WorstFigure parts,
      advance;  // parts: the most into which a step was split; advance: the least of a frame, in dt, if slow_told
  WorstOverlap crushed;  // overlap of a disk that a moving wall crushed; it ended the run
};

struct State {
  Disks disks;
  double time = 0.0;
  Counters counters;
  DiskId next_id = 0;
  Count intervals = 0;               // Brownian intervals of dt begun (rollback, whose frames are shorter than dt),
                                     // or kicks of a thermostat
  bool step_begun = false;           // sources (pairwise: and draws) of the next step are done, the step itself is not
  std::vector<SourceState> sources;  // one per scene source
  SinkCounts taken;                  // by sink number, adding up to Counters::removed; empty in scenes without sinks
  std::vector<ContactLoad> loads;    // in order of (id1, id2); empty unless the scene settles
  StallWatch stall;                  // rollback, exact
  ValidityCounts validity;           // kept in checkpoints, so that a resumed run gives the same warnings
  double window = 0.0;  // exact: planned length of the next window; time, 0 before the first, < 0 after a crowded one
  std::vector<Obstacle> obstacles;          // never change; in contacts they are obstacle_partner(place in this list)
  std::vector<double> last_contact;         // exact with the TC model: by id, time of the last collision; else empty
  std::vector<std::uint32_t> thermal_hits;  // with thermal sides: by id, thermal reflections so far; else empty
};

}  // namespace carom
