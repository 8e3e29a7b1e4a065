// Checks of a disk that a program adds to a run, and of a velocity that it sets; and whether there is room for the
// disk.
#pragma once

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state.hpp"
#include "core/scene/scene.hpp"
#include "run/simulation/disk_queries.hpp"

namespace carom {

// Throws InputError for a component beyond the range of speeds.
void check_velocity(Vec2 velocity);

// Throws InputError for numbers out of range, a disk that reaches out of the box or is too large for a periodic side,
// and if no id is left.
void check_newcomer(const Scene& scene, const State& state, const Disk& disk);

// Is the disk clear of all other disks, fixed disks, inner walls and sinks at their present places, and of sides that
// have moved in? near: visits the disks of the state. fixed: of the scene, null if there are none. Precondition:
// check_newcomer accepts the disk.
bool has_room(const Scene& scene, const State& state, const Disk& disk, const VisitNear& near,
              const ObstacleCells* fixed);

}  // namespace carom
