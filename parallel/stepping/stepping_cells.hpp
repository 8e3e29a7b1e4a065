// The cells of time stepping on one machine.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Makes the cells for these disks at their present positions; more of them if disks are crowded. count: set to the
// number of disks of each class (class_of_radius). The memory of count and grid is reused. Precondition: there are
// disks.
void make_stepping_cells(const Disks& disks, const Domain& box, std::vector<std::size_t>& count, CellGrid& grid);

}  // namespace carom
