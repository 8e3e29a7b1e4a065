// The cells of the exact method, in tiles: rectangles of the box whose disks are neighbours in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Makes a grid of tiles of about disks_per_tile disks, where those are spread evenly. Each tile has cells of all size
// classes, with about five disks each. The tiles lie in layers across the box's longer side, one layer after the other
// in memory; where the box is long enough, so many regions get the same number of layers. count[k] is the number of
// disks of size class k (class_of_radius). The memory that grid has is used again.
void make_tiled_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                     std::size_t disks_per_tile, std::size_t regions, CellGrid& grid);

// How many disks a tile should have: at most as many as wanted, unless there would be too many tiles then, and such
// that its cells, whose number is a power of two, have as many disks as they should. Cells with half as many would take
// twice the memory.
std::size_t even_tile(std::size_t wanted, std::size_t disks_of_box);

// Keeps only the tiles between about these heights; they may lie across the bottom and the top of a periodic box. A
// disk elsewhere is in the row of cells that is nearest among those kept. Where few would be left out, all are kept.
void keep_tiles_between(const Domain& box, double low, double high, CellGrid& grid);

}  // namespace carom
