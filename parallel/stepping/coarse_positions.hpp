// Positions of 32 bits for each disk, which the contact search reads instead of the coordinates: eight disks are tested
// at once, and only pairs that may touch are then tested in double precision.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/disks.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// The number of coarse positions that are read at once; columns have this many entries more than disks, since a read
// may go beyond the last disk.
inline constexpr std::uint32_t coarse_lanes = 8;

// Columns have an entry for each disk, by storage index, and coarse_lanes more. A coordinate is rounded to a whole
// number of units of the disk's level, and the lowest 16 bits of that number are kept: x in the lower half, y in the
// upper. The difference of two coordinates is then off by at most one unit, or by 2^16 units, which is far more than a
// contact distance. So two disks may seem near that are not, but never the reverse.
struct CoarsePositions {
  std::vector<std::uint32_t> position;
  std::vector<std::uint32_t> radius;  // in units, rounded up; empty: all disks have the common one
  // Disks that have more than coarse_lanes others in one of their two runs (near_runs), ascending.
  std::vector<std::uint32_t> long_runs;
  // For each block of disks, the strays: disks that have left their cell by more than the level's margin.
  std::vector<std::vector<std::uint32_t>> strays;
  std::size_t blocks = 0;  // number of blocks in the last drift
  // Loose disks, ascending: disks that a program has added between two steps, or that took the place of a removed one.
  // Their keys do not belong to their positions. Those stored after all sorted disks are in no cell's run.
  std::vector<std::uint32_t> loose;
  bool current = false;  // position and strays belong to the present positions
  // Scratch.
  std::vector<double> speed2;
  std::vector<std::vector<std::uint32_t>> long_runs_of_block;
};

// The cell list of time stepping: the grid, the disks sorted into each cell, and their present coarse positions.
struct CellList {
  CellGrid grid;
  SortedCells sorted;
  CoarsePositions coarse;
};

// The unit of a level's coarse coordinates; length. The longer side of a cell is 4096 units, a sixteenth of the range
// of 16 bits, so that disks that are read beyond the wanted cells do not seem near. In a dense fluid a diameter is
// about 3400 units.
inline double coarse_unit(const GridLevel& level) {
  return std::max(level.cell_width, level.cell_height) / 4096.0;
}

// A bound on the error of the distance of two coarse positions, in units: each coordinate has an error of at most one
// half, a difference of one, and the distance of the square root of two. With unequal radii, which are rounded up to
// whole numbers, the next whole number is added to their sum.
inline constexpr double coarse_error = 1.5;
inline constexpr std::uint32_t coarse_radius_error = 2;

// Disks whose squared coarse distance is this or more do not touch.
inline std::uint32_t coarse_contact2(double contact_distance, const GridLevel& level) {
  const double reach = contact_distance / coarse_unit(level) + coarse_error;
  return static_cast<std::uint32_t>(reach * reach) + 2U;
}

// Disks [first, last) of a level.
struct LevelRange {
  std::size_t first, last;
};
inline LevelRange range_of(const GridLevel& level, const SortedCells& cells) {
  return {cells.start[level.start_key()], cells.start[level.start_key() + level.keys()]};
}

// The two runs of disks with which the search compares a disk, away from periodic sides: those after it in its own and
// in the next cell, and those of the three cells above.
struct NearRuns {
  std::uint32_t own, own_end, above, above_end;
};
inline NearRuns near_runs(const std::uint32_t* start, std::uint32_t key, std::uint32_t stride, std::uint32_t i) {
  return {i + 1, start[key + 2], start[key + stride - 1], start[key + stride + 2]};
}

// Prepares cells.coarse for all disks: radii, and the list of disks with long runs. To be called each time the disks
// have been sorted into cells.
void begin_coarse_positions(const Disks& disks, const Executor& executor, CellList& cells);

}  // namespace carom
