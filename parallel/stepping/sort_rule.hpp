// The margin of the cells of time stepping, and when disks are sorted anew: the same on one machine and on ranks.
#pragma once

#include <cstddef>

#include "parallel/cells/cell_grid.hpp"

namespace carom {

// The distance by which a disk may leave its cell (grid_margin): twice the usual one, since the search tests eight
// disks as fast as four, and sorting costs more than testing some more disks.
inline constexpr double stepping_margin = 2.0 * grid_margin;

// All disks are sorted anew when one in so many is a stray (has left its cell by more than the margin). Searching for a
// stray by itself costs as much as sorting about a dozen disks, and the number of strays grows quickly from step to
// step. Measured best for a fluid.
inline constexpr std::size_t disks_a_stray = 200;

constexpr bool are_many_strays(std::size_t strays, std::size_t disks) {
  return strays * disks_a_stray > disks;
}

}  // namespace carom
