// The contact search: all pairs that touch, from rows of cells, each once, in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair.hpp"
#include "core/physics/contact_event.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// What each block of the search found, in order of storage. One buffer for each block: nothing is dropped because a
// buffer was full, and the order of the pairs depends on the blocks alone. Pairs name the disks in order of storage;
// ids are not looked at.
struct FoundPairs {
  std::vector<std::vector<Pair>> buffers;
  std::size_t used = 0;   // buffers of this search
  double furthest = 0.0;  // that a stray has left its cell by; length
  // Of the strays' own search.
  std::vector<std::uint32_t> strays;
  std::vector<unsigned char> strayed;  // of each disk: 1 a stray, 2 a loose one; all 0 between searches

  std::size_t count() const {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < used; ++b) sum += buffers[b].size();
    return sum;
  }
};

// The pair with the smaller id first, as every formula wants it.
inline Pair in_id_order(const DiskId* id, Pair p) {
  return id[p.i1] < id[p.i2] ? p : Pair{p.i2, p.i1};
}

// Finds the pairs of disks that overlap or touch now; disks moved since they were sorted into cells. Rows of cells find
// the pairs of all disks that are still within the margin of their cells; every stray is searched for by itself, as far
// as any stray has gone. So the result is complete however old the cells are; they only become slow. Returns the number
// of strays, loose disks (coarse_positions.hpp) among them. Precondition: coarse is current.
std::size_t find_contacts(const Disks& disks, const Domain& box, const CellGrid& grid, const SortedCells& cells,
                          const CoarsePositions& coarse, const Executor& executor, FoundPairs& found);

// How far a disk has left its cell by at most, loose disks apart; length.
double furthest_excursion(const Disks& disks, const Domain& box, const CellGrid& grid, const SortedCells& cells,
                          const CoarsePositions& coarse);

}  // namespace carom
