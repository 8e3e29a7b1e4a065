// Moves all disks, in blocks.
#pragma once

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/gravity.hpp"
#include "core/physics/step_rules.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/stepping/find_contacts.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Drifts every disk by t (negative: back) and wraps centres across periodic sides; writes coarse positions and strays
// to cells.coarse. Returns the largest squared speed after it. Each disk by itself: no order can matter.
// Preconditions: the disks are stored in the order of cells, and begin_coarse_positions was called since.
double drift_blocks(Disks& disks, const Domain& box, const Gravity& gravity, double t, const Executor& executor,
                    CellList& cells);

// Only writes coarse positions and strays, after disks have been moved in another way. Same preconditions.
void note_coarse_positions(Disks& disks, const Domain& box, const Executor& executor, CellList& cells);

// Fills found.walls with the wall contacts of all disks, by blocks in order of storage. Does nothing without walls.
void find_wall_contacts(Disks& disks, const StepRules& rules, const Executor& executor, FoundContacts& found);

}  // namespace carom
