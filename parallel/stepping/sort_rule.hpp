// How wide the cells of time stepping are, and when its disks are sorted into them anew: on one machine and on ranks.
#pragma once

#include <cstddef>

#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Part of a cell by which a disk may leave it, over the largest diameter: twice the usual, as the search tests eight
// disks as fast as four, and sorting costs more than looking at some more disks.
inline constexpr double stepping_margin = 2.0 * grid_margin;

// One in so many disks is a stray, that has left its cell further, when all are sorted: searching for a stray by itself
// costs as much as sorting about a dozen disks, and their number grows quickly from step to step. Measured best for a
// fluid.
inline constexpr std::size_t disks_a_stray = 200;

constexpr bool are_many_strays(std::size_t strays, std::size_t disks) {
  return strays * disks_a_stray > disks;
}

}  // namespace carom
