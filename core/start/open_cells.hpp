// Where a disk may still find room: the box in small cells, less those that placed disks rule out.
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

// Heights between which rows of cells are known; length.
struct KnownHeights {
  double low = -HUGE_VAL, high = HUGE_VAL;
};

// For disks of radius smallest and more. A cell is closed when one placed disk rules out every centre in it, or when it
// lies within smallest of a wall or sink; a point in a closed cell need not be tried. One bit a cell, about 100 cells a
// disk: this makes the last disks of a dense random start cheap, when only one place in thousands is free.
class OpenCells {
 public:
  // region: null, or where whole disks are to lie; it must outlive this. known: only the rows of tiles (VoxelList)
  // whose lower edge lies in [low, high) are here, so that several may share the box.
  OpenCells(const Domain& box, double smallest, std::size_t disks, const StartRegion* region = nullptr,
            const KnownHeights& known = {});

  // Closes what a disk placed at (x, y) rules out.
  void close_around(double x, double y, double radius);

  // Precondition: all rows are here.
  bool is_open(double x, double y) const { return !closed(row_of(y) * columns_ + column_of(x)); }

  std::size_t open() const { return open_; }                        // cells that are here
  double tile_height() const { return cell_y_ * VoxelList::tile; }  // length

  // True when so few cells are open that it pays to draw from a list of them. open: of the whole box.
  bool list_due(std::size_t open) const;
  bool list_due() const { return list_due(open_); }

  // The open cells that are here, in tiles. Memory: at most 4 entries of 8 bytes a disk; that of the cells is given
  // back as they are read, so that they and the list are never there as a whole. Nothing may be asked of the cells
  // afterwards.
  VoxelList list();

  // Asks for the memory that is_open is about to read.
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
  std::size_t first_row_ = 0, end_row_ = 1;  // that are here
  double cell_x_ = 0.0, cell_y_ = 0.0;       // length
  std::size_t open_ = 0;                     // cells
  std::vector<std::uint64_t> bits_;          // 1: closed; row by row, from first_row_ on
};

}  // namespace carom
