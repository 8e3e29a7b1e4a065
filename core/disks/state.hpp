// The state of a run: the disks, the time, and what has been counted so far. Nothing else changes while a run goes on.
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
  Count steps = 0;                // steps of dt (frames for rollback, windows for exact)
  Count collisions = 0;           // disk-disk
  Count wall_collisions = 0;      // disk-wall
  Count removed = 0;              // by sinks
  Count emitted = 0;              // by sources
  Count waiting = 0;              // due from a source, no room found yet
  double disk_time = 0.0;         // for how long each disk was there, all together; of stepping see count_step; time
  double disk_time_excess = 0.0;  // by which rounding has made that sum too large
  double virial = 0.0;            // sum over disk-disk collisions of |impulse| (r1 + r2); mass length^2 / time
  // That disks from sources came with, of motion, position and rotation; and that changes by a program brought.
  double emitted_energy = 0.0;
  double wall_impulse[4] = {0, 0, 0, 0};  // sum of |impulse| on each side (order of Side); mass length / time
  // Energy that each side has given to the disks: heat of a thermal one, work of one that moves.
  double side_energy[4] = {0, 0, 0, 0};
  double thermostat_heat = 0.0;  // that a thermostat has given to the disks; energy
  // In a sheared box: as virial, times nx ny, n from one centre to the other; and the work that the shear has done.
  double shear_virial = 0.0, shear_work = 0.0;
  // Energy and momentum (x, y) that inner walls which move have given to the disks.
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

// How far time had come when the method was last seen to advance (core/step/rollback_frame.hpp,
// core/step/window_plan.hpp).
struct StallWatch {
  Count frames = 0;  // since then; of exact: crowded windows in a row
  double since = 0.0;
};

// The worst that was seen of something, and when.
struct WorstOverlap {
  Overlap overlap;
  double time = 0.0;  // end of the step
};
struct WorstFigure {
  double figure = 0.0;
  double time = 0.0;  // of the step or frame
};

// What the method was seen to do wrong, and what has been said of it (core/step/validity.hpp). No disk depends on
// it; a run ends where disks are crushed.
struct ValidityCounts {
  Count inaccurate = 0;           // collisions
  Count inaccurate_at_walls = 0;  // time stepping: those with walls and obstacles, which are not in `inaccurate`
  Count frames = 0;               // of rollback, since `since`
  double since = 0.0;             // simulated time at which the frames that are watched begin
  bool split_told = false, overlap_told = false, inaccurate_told = false, slow_told = false;
  bool late_at_walls_told = false;
  WorstOverlap disks, wall;    // of two disks, of a disk and a wall
  WorstFigure parts, advance;  // most parts that a step was split into; least advance of a frame in dt, if told
  WorstOverlap crushed;        // by a wall that moves, of a disk and what it is pressed into; the run ended there
};

struct State {
  Disks disks;
  double time = 0.0;
  Counters counters;
  DiskId next_id = 0;
  Count intervals = 0;               // Brownian intervals of dt begun (rollback, whose frames are shorter than dt),
                                     // or kicks of a thermostat
  bool step_begun = false;           // the coming step has had its sources (pairwise: and draws), but was not made
  std::vector<SourceState> sources;  // one per scene source
  SinkCounts taken;                  // by each sink, together Counters::removed; an entry for each, or none without
  std::vector<ContactLoad> loads;    // in order of (id1, id2); empty unless the scene settles
  StallWatch stall;                  // rollback, exact
  ValidityCounts validity;           // counted on in a run that is taken up again, so that it warns of the same
  double window = 0.0;  // exact: length meant for the next window; time, 0 before the first, < 0 after a crowded one
  std::vector<Obstacle> obstacles;   // never change; a contact's id2 is obstacle_partner of the place in this list
  std::vector<double> last_contact;  // exact with the TC model: by id, time of the last collision; else empty
  std::vector<std::uint32_t> thermal_hits;  // with thermal sides: by id, reflections by one so far; else empty
};

}  // namespace carom
