// Sorts the disks into cells: a stable counting sort by two digits, whose result does not depend on threads.
#pragma once

#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The disks of each cell after the sort, and the scratch memory of the sort.
struct SortedCells {
  std::vector<std::uint32_t> key;    // of each disk, in storage order: ascending
  std::vector<std::uint32_t> start;  // keys + 1: first disk of each cell
  // Scratch, kept so that a warm step allocates nothing.
  std::vector<std::uint32_t> order, pass;  // n each
  std::vector<std::uint32_t> counts;       // histograms of the blocks
  std::vector<double> column;              // n: a column being moved
};

// Moves all columns so that keys ascend; disks of one cell keep their order. Same result for any thread count: the
// histograms of fixed blocks are scanned in (bucket, block) order, then every bucket is sorted by itself.
void sort_into_cells(Disks& disks, const CellGrid& grid, const Executor& executor, SortedCells& cells);

// Frees everything but the disks of each cell.
void release_sort_scratch(SortedCells& cells);

}  // namespace carom
