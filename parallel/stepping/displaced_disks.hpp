// Whether resolving a step's contacts has pressed disks together that were not among them: core/step/step_rounds.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Where the disks were before resolving, and lists that are filled again and again.
struct DisplacedDisks {
  std::vector<double> x, y;
  std::vector<std::vector<std::uint32_t>> blocks;  // displaced disks of each block
  std::vector<std::uint32_t> all;
  std::vector<double> furthest2;       // of each block: largest squared displacement
  std::vector<unsigned char> pressed;  // of each block of displaced disks
};

// Keeps the places that the disks have now.
void keep_places(const Disks& disks, const Executor& executor, DisplacedDisks& displaced);

// Puts the disks that were displaced since keep_places into displaced.all. Returns how far the furthest one was;
// length.
double find_displaced(Disks& disks, const Domain& box, const Executor& executor, DisplacedDisks& displaced);

// Is one of displaced.all pressed into another disk or into a wall? slack: how far a disk may be outside the cell that
// it was sorted into; length.
bool any_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, const Executor& executor,
                 DisplacedDisks& displaced);

// The same of disk i alone, which need not be in any cell.
bool is_pressed(Disks& disks, const Domain& box, const CellList& cells, double slack, std::size_t i);

// Is a disk that was displaced since keep_places pressed into another one or into a wall? strayed: by how much a disk
// had left its cell at most when the places were kept; length. The answer is the reference's.
bool presses_others(Disks& disks, const Domain& box, const CellList& cells, double strayed, const Executor& executor,
                    DisplacedDisks& displaced);

}  // namespace carom
