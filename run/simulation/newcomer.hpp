// A disk that a program adds to a run, and a velocity that it gives: may they be so, and is there room?
#pragma once

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "run/simulation/disk_queries.hpp"

namespace carom {

// Throws InputError for a component beyond the range of speeds.
void check_velocity(Vec2 velocity);

// Throws InputError for numbers out of range, a disk that reaches out of the box, one that is too large for a periodic
// side, and where no id is left.
void check_newcomer(const Scene& scene, const State& state, const Disk& disk);

// Does the disk overlap no other one, no fixed one, no inner wall or sink where it is now, and no side that has moved
// in? near: visits the disks of the state; fixed: of the scene, null where there are none. Precondition: the disk is as
// check_newcomer wants it.
bool has_room(const Scene& scene, const State& state, const Disk& disk, const VisitNear& near,
              const ObstacleCells* fixed);

}  // namespace carom
