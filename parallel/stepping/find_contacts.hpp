// The contact search: all pairs that touch, from rows of cells, each once, in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair.hpp"
#include "core/physics/contact_event.hpp"
#include "parallel/stepping/coarse_positions.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The contacts of a step, as the search and find_wall_contacts (drift_blocks.hpp) find them. Each block of disks has a
// buffer of its own: nothing is dropped because a buffer was full, and the order of the contacts depends on the blocks
// alone. Pairs name disks by storage index, not in order of their ids.
struct FoundContacts {
  std::vector<std::vector<Pair>> buffers;  // the first `used` are of the last search
  std::size_t used = 0;
  std::vector<std::vector<ContactEvent>> walls;  // empty in a box without walls
  double furthest = 0.0;                         // largest distance of a stray from its cell; length
  // Scratch: for each block, the disks that may touch a wall or an obstacle.
  std::vector<std::vector<std::uint32_t>> near_walls;
  // Scratch of the strays' own search.
  std::vector<std::uint32_t> strays;
  std::vector<unsigned char> strayed;  // of each disk: 1 a stray, 2 a loose one; all 0 between searches

  // offset: the index of each buffer's first pair in a list of all pairs. Returns the number of pairs.
  std::size_t find_offsets(std::vector<std::size_t>& offset) const {
    offset.clear();
    std::size_t sum = 0;
    for (std::size_t b = 0; b < used; ++b) {
      offset.push_back(sum);
      sum += buffers[b].size();
    }
    return sum;
  }
  std::size_t wall_contacts() const {
    std::size_t sum = 0;
    for (const std::vector<ContactEvent>& block : walls) sum += block.size();
    return sum;
  }
};

// The pair with the smaller id first, as all formulas require.
inline Pair in_id_order(const DiskId* id, Pair p) {
  return id[p.i1] < id[p.i2] ? p : Pair{p.i2, p.i1};
}

// Finds the pairs of disks that overlap or touch now; disks have moved since they were sorted into cells. The search by
// rows of cells finds the pairs of all disks that are still within the margin of their cells. Every stray is searched
// for by itself, with the largest distance of any stray as margin. So the result is complete for cells of any age; only
// the search becomes slower. Returns the number of strays, loose disks (coarse_positions.hpp) among them. Precondition:
// cells.coarse is current.
std::size_t find_contacts(const Disks& disks, const Domain& box, const CellList& cells, const Executor& executor,
                          FoundContacts& found);

// The largest distance of a disk from its cell, without loose disks; length.
double furthest_excursion(const Disks& disks, const Domain& box, const CellList& cells);

}  // namespace carom
