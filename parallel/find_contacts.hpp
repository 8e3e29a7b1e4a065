// The contact search: all pairs that touch, from rows of cells, each once, in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/contact_event.hpp"
#include "core/disks.hpp"
#include "core/domain.hpp"
#include "core/pair_search.hpp"
#include "parallel/cell_grid.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/executor.hpp"

namespace carom {

// One buffer for each block of the search: nothing is dropped because a buffer was full, and the order of the pairs
// depends on the blocks alone.
struct FoundPairs {
  std::vector<std::vector<Pair>> buffers;
  std::size_t used = 0;           // buffers of this search
  std::vector<double> excursion;  // of each block, for the check of the margin

  std::size_t count() const {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < used; ++b) sum += buffers[b].size();
    return sum;
  }
};

// Finds the pairs of disks that overlap or touch now; disks moved since they were sorted into cells. Returns by how
// much of its level's margin the worst disk has left its cell: above 1 the grid is too old, pairs may be missing, and
// the disks must be sorted and searched again. Pairs have the smaller id first; their order is that of storage.
double find_contacts(const Disks& disks, const Domain& box, const CellGrid& grid, const SortedCells& cells,
                     const Executor& executor, FoundPairs& found);

}  // namespace carom
