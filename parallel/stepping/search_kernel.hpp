// The input of the search of one block, and the interior kernel in versions for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/disks/domain.hpp"
#include "core/disks/pair.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

struct SearchInput {
  const double* x;
  const double* y;
  const double* radius;  // null: common_radius
  double common_radius;
  const std::uint32_t* position;                // coarse (coarse_positions.hpp)
  const std::uint32_t* coarse_radius;           // null: common_radius
  const std::vector<std::uint32_t>& long_runs;  // as in CoarsePositions
  const std::uint32_t* key;
  const std::uint32_t* start;
  std::size_t n;  // all disks
  Domain box;
  double period_x, period_y;  // infinite if not periodic
};

// Tests disks [begin, end) of one row of one level, all away from periodic sides, against the disks after them in their
// own row and those of the row above: two contiguous runs for each disk. Coarse positions are tested with vectors, and
// pairs that may touch by the scalar formula. Appends the pairs that touch.
using InteriorKernel = void (*)(const SearchInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                                std::vector<Pair>& pairs);

void search_interior_baseline(const SearchInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                              std::vector<Pair>& pairs);
void search_interior_avx2(const SearchInput& in, const GridLevel& level, std::size_t begin, std::size_t end,
                          std::vector<Pair>& pairs);

// The best version for this processor; all give the same pairs in the same order.
InteriorKernel choose_interior_kernel();

}  // namespace carom
