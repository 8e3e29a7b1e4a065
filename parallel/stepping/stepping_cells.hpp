// The cells of time stepping on one machine.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Cells for these disks, where they are now; more of them where disks crowd. count: becomes the number of disks of each
// class (class_of_radius). The memory that both have is used again. Precondition: there are disks.
void make_stepping_cells(const Disks& disks, const Domain& box, std::vector<std::size_t>& count, CellGrid& grid);

}  // namespace carom
