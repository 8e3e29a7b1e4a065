// Positions of 32 bits a disk, which the contact search reads in place of the coordinates: eight disks are tested at
// once, and only pairs that may touch are asked in double precision.
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

// Coarse positions that are read at once; so many more entries than disks may be read.
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
  // Of each block of disks, the strays: those that have left their cell by more than the level's margin.
  std::vector<std::vector<std::uint32_t>> strays;
  std::size_t blocks = 0;  // how many blocks have strays of the last drift
  // Disks that a program added between two steps, and disks that took the place of one that it removed, ascending:
  // their keys say nothing of where they are. Those stored behind all sorted disks are in no cell's run.
  std::vector<std::uint32_t> loose;
  bool current = false;  // position and strays are of where the disks are now
  // Scratch.
  std::vector<double> speed2;
  std::vector<std::vector<std::uint32_t>> long_runs_of_block;
};

// The cell list of time stepping: the grid, which disks were sorted into each cell, and where the disks are now.
struct CellList {
  CellGrid grid;
  SortedCells sorted;
  CoarsePositions coarse;
};

// A unit of the level's coarse coordinates; length. The longer side of a cell is 4096 units, a sixteenth of what 16
// bits hold: disks that are read beyond the cells of interest then do not seem near. In a dense fluid a diameter is
// about 3400 units.
inline double coarse_unit(const GridLevel& level) {
  return std::max(level.cell_width, level.cell_height) / 4096.0;
}

// The distance of two coarse positions is off by less than this, in units: each coordinate by at most one half, a
// difference by one, and the distance by the square root of two. With unequal radii, which are whole numbers, the sum
// gets the next whole number above that.
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

// The runs of disks in storage that the search compares a disk with, away from periodic sides: what follows it in its
// own cell and in the next one, and the disks of the three cells above.
struct NearRuns {
  std::uint32_t own, own_end, above, above_end;
};
inline NearRuns near_runs(const std::uint32_t* start, std::uint32_t key, std::uint32_t stride, std::uint32_t i) {
  return {i + 1, start[key + 2], start[key + stride - 1], start[key + stride + 2]};
}

// Makes room in cells.coarse for all disks, with their radii, and finds those that have long runs. To be called once
// the disks have been sorted into cells.
void begin_coarse_positions(const Disks& disks, const Executor& executor, CellList& cells);

}  // namespace carom
