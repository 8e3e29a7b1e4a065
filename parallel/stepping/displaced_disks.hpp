// Whether resolving a step's contacts has pressed disks together that were not among them: core/step/step_rounds.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
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

// Is a disk that was displaced since keep_places pressed into another one or into a wall? strayed: length by which a
// disk had left its cell at most when the places were kept. The answer is the reference's.
bool presses_others(Disks& disks, const Domain& box, const CellGrid& grid, const SortedCells& cells, double strayed,
                    const Executor& executor, DisplacedDisks& displaced);

}  // namespace carom
