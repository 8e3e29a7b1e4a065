// Tests whether a new disk has room among disks that are sorted into cells.
#pragma once

#include "core/step/source.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/cells/nearby_runs.hpp"

namespace carom {

// Does the newcomer overlap or touch one of the disks? Precondition: they are stored in the order of the cells, and
// none has moved since it was sorted.
inline bool meets_nearby(const Disks& d, const Domain& box, const CellGrid& grid, const SortedCells& cells,
                         const Disk& newcomer) {
  bool met = false;
  for (std::size_t k = 0; k < grid.levels.size() && !met; ++k) {
    const GridLevel& level = grid.levels[k];
    for_each_run_near(
        level, cells.start.data(), box, newcomer.x, newcomer.y, newcomer.radius + level.largest_radius,
        [&](std::uint32_t first, std::uint32_t last) { met = met || meets(d, box, newcomer, first, last); });
  }
  return met;
}

}  // namespace carom
