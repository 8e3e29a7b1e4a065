// The cells of the exact method, in tiles: rectangles of the box whose disks are neighbours in memory.
#pragma once

#include <cstddef>
#include <vector>

#include "core/disks/domain.hpp"
#include "parallel/cells/cell_grid.hpp"

namespace carom {

// A grid of tiles of at most about disks_per_tile disks, if those are spread evenly, each with the cells of all size
// classes: about five disks a cell. The tiles lie in layers across the box's longer side, one after the other in
// memory, that can be shared out among this many regions, the same number to each, if the box is long enough. count[k]
// is the number of disks of class k (class_of_radius), whose largest radius is largest_radius / class_ratio^k. The
// memory that grid has is used again.
void make_tiled_grid(const Domain& box, double largest_radius, const std::vector<std::size_t>& count,
                     std::size_t disks_per_tile, std::size_t regions, CellGrid& grid);

// No more disks than wanted, but where there would be too many tiles, such that cells have as many disks as they
// should: cells with half as many take twice the memory.
std::size_t even_tile(std::size_t wanted, std::size_t disks_of_box);

// Only the tiles between these heights, about, are kept; they may lie across the bottom and the top of a periodic box.
// A disk elsewhere is in the row of cells that is nearest among those kept. Where the others would be few, all stay.
void keep_tiles_between(const Domain& box, double low, double high, CellGrid& grid);

}  // namespace carom
