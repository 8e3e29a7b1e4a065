// The cells of the exact method, in tiles: rectangles of the box whose disks are neighbours in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// Makes a grid of tiles of about disks_per_tile disks if disks are evenly spread. Each tile has cells of all size
// classes, with about five disks each. The tiles are in layers across the box's longer side, one layer after the other
// in memory; if the box is long enough, all regions (of this number) have the same number of layers. count[k] is the
// number of disks of size class k (class_of_radius). The memory of grid is reused.
void make_tiled_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                     std::size_t disks_per_tile, std::size_t regions, CellGrid& grid);

// The number of disks for a tile: at most the number wanted, unless there would be too many tiles, and such that the
// tile's cells, whose number is a power of two, are well filled. Cells with half as many disks would take twice the
// memory.
std::size_t even_tile(std::size_t wanted, std::size_t disks_of_box);

// Keeps only the tiles between about these heights; the range may extend across the bottom and the top of a periodic
// box. A disk elsewhere is put into the nearest row of cells that is kept. If few tiles would be left out, all are
// kept.
void keep_tiles_between(const Domain& box, double low, double high, CellGrid& grid);

}  // namespace carom
