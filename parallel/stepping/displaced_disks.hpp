// Finds whether resolving the contacts of a step has pressed together disks that had no contact
// (core/step/step_rounds.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The positions before resolving, and reused lists.
struct DisplacedDisks {
  std::vector<double> x, y;
  std::vector<std::vector<std::uint32_t>> blocks;  // displaced disks of each block
  std::vector<std::uint32_t> all;
  std::vector<double> furthest2;       // of each block: largest squared displacement
  std::vector<unsigned char> pressed;  // of each block of displaced disks
};

// Stores the present positions.
void keep_places(const Disks& disks, const Executor& executor, DisplacedDisks& displaced);

// Fills displaced.all with the disks that were displaced since keep_places. Returns the largest displacement; length.
double find_displaced(Disks& disks, const Domain& box, const Executor& executor, DisplacedDisks& displaced);

// Is one of displaced.all pressed into another disk or into a wall? slack: the largest distance of a disk from the cell
// into which it was sorted; length.
bool any_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, const Executor& executor,
                 DisplacedDisks& displaced);

// The same of disk i alone, which need not be in any cell.
bool is_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, std::size_t i);

// Is a disk that was displaced since keep_places pressed into another one or into a wall? strayed: the largest distance
// of a disk from its cell at keep_places; length. The result is that of the reference.
bool presses_others(Disks& disks, const Domain& box, const CellList& cells, double strayed, const Executor& executor,
                    DisplacedDisks& displaced);

}  // namespace carom
