// The part of the box where a disk may still find room, in small cells: those that no placed disk rules out.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/cell_index.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"
#include "core/start/voxel_list.hpp"

namespace carom {

// The range of heights whose rows of cells are held; length.
struct KnownHeights {
  double low = -HUGE_VAL, high = HUGE_VAL;
};

// For disks of radius `smallest` or more. A cell is closed if one placed disk rules out every centre in it, or if it
// lies within `smallest` of a wall or sink; points in closed cells need not be tried. One bit for each cell, about 100
// cells for each disk. This makes the last disks of a dense random start cheap, when only one place in thousands is
// free.
class OpenCells {
 public:
  // region: null, or the region in which whole disks have to lie; it must outlive this. known: only rows of tiles
  // (VoxelList) whose lower edge lies in [low, high) are held, so that several ranks may share the box.
  OpenCells(const Domain& box, double smallest, std::size_t disks, const StartRegion* region = nullptr,
            const KnownHeights& known = {});

  // Closes the cells that a disk placed at (x, y) rules out.
  void close_around(double x, double y, double radius);

  // Precondition: all rows are held.
  bool is_open(double x, double y) const { return !closed(row_of(y) * columns_ + column_of(x)); }

  std::size_t open() const { return open_; }                        // cells held
  double tile_height() const { return cell_y_ * VoxelList::tile; }  // length

  // Are so few cells open that it pays to draw from a list of them? open: number in the whole box.
  bool list_due(std::size_t open) const;
  bool list_due() const { return list_due(open_); }

  // The list of open cells held, by tiles: at most 4 entries of 8 bytes for each disk. The memory of the cells is given
  // back while they are read, so that cells and list are never held completely at the same time. The cells must not be
  // used afterwards.
  VoxelList list();

  // Prefetches the memory that is_open will read.
  void prefetch_cell(double x, double y) const {
    __builtin_prefetch(&bits_[(row_of(y) * columns_ + column_of(x)) / 64]);
  }

 private:
  std::size_t column_of(double x) const { return cell_index(x / cell_x_, columns_); }
  std::size_t row_of(double y) const { return cell_index(y / cell_y_, rows_); }
  bool closed(std::size_t cell) const { return (bits_[cell / 64] >> (cell % 64) & 1U) != 0; }
  std::size_t first_row_from(double height) const;
  void read_row(std::size_t row, std::vector<Voxel>& open) const;
  void close_span(std::size_t row, std::size_t first, std::size_t count);
  void close_columns(double row, double first, double last);
  void close_margins(double smallest);
  void close_outside();

  Domain box_;
  const StartRegion* region_;
  double smallest_;
  std::size_t disks_;
  std::size_t columns_ = 1, rows_ = 1;       // of the whole box
  std::size_t first_row_ = 0, end_row_ = 1;  // held
  double cell_x_ = 0.0, cell_y_ = 0.0;       // length
  std::size_t open_ = 0;                     // cells
  std::vector<std::uint64_t> bits_;          // 1: closed; row by row from first_row_ on
};

}  // namespace carom
