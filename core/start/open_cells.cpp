#include "core/start/open_cells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "core/base/huge_pages.hpp"
#include "core/start/start_region.hpp"

namespace carom {

namespace {

// Cells across the smallest radius. At packing fraction 0.5 this makes 100 cells (12 bytes) for each disk. Finer cells
// cover the excluded area more closely, coarser ones cost less.
constexpr double cells_per_radius = 4.0;
constexpr std::size_t most_cells_per_disk = 128;
constexpr std::size_t most_cells = 0xffffffffU;  // 512 MiB of bits
constexpr std::size_t listed_per_disk = 4;
constexpr std::size_t least_listed = 4096;

// Many pages at a time, since each call breaks up a huge page.
constexpr std::size_t words_given_back = std::size_t{1} << 15;

// Spans stay inside a circle by this share of a cell, so that rounding never closes a cell wrongly.
constexpr double cell_margin = 1e-6;

}  // namespace

OpenCells::OpenCells(const Domain& box, double smallest, std::size_t disks, const StartRegion* region,
                     const KnownHeights& known)
    : box_(box), region_(region), smallest_(smallest), disks_(disks) {
  const auto most = static_cast<double>(std::min(most_cells, most_cells_per_disk * disks + 4096));
  const double edge = std::max(smallest / cells_per_radius, box.width * std::sqrt(box.height / box.width / most));
  columns_ = static_cast<std::size_t>(std::clamp(box.width / edge, 1.0, most));
  rows_ = static_cast<std::size_t>(std::clamp(box.height / edge, 1.0, most / static_cast<double>(columns_)));
  cell_x_ = box.width / static_cast<double>(columns_);
  cell_y_ = box.height / static_cast<double>(rows_);
  first_row_ = first_row_from(known.low);
  end_row_ = std::max(first_row_, first_row_from(known.high));
  open_ = columns_ * (end_row_ - first_row_);
  resize_in_huge_pages(bits_, open_ / 64 + 1);
  close_margins(smallest);
  if (region_ != nullptr) close_outside();
}

// The first row of the first tile whose lower edge is at or above `height`.
std::size_t OpenCells::first_row_from(double height) const {
  const auto rows = static_cast<double>(rows_);
  const double row = std::ceil(std::clamp(height / tile_height(), -1.0, rows)) * VoxelList::tile;
  return static_cast<std::size_t>(std::clamp(row, 0.0, rows));
}

void OpenCells::close_outside() {
  for (std::size_t row = first_row_; row < end_row_; ++row) {
    const double low = static_cast<double>(row) * cell_y_;
    for (std::size_t column = 0; column < columns_; ++column) {
      const double left = static_cast<double>(column) * cell_x_;
      const bool allowed = may_hold_centre(*region_, box_, {left, low}, {left + cell_x_, low + cell_y_}, smallest_);
      if (!allowed) close_span(row, column, 1);
    }
  }
}

void OpenCells::close_margins(double smallest) {
  const auto cells = [&](double cell) {
    return static_cast<std::size_t>(std::max(0.0, smallest / cell - cell_margin));
  };
  const std::size_t across = box_.periodic_x() ? 0 : std::min(cells(cell_x_), columns_ / 2);
  const std::size_t up = box_.periodic_y() ? 0 : std::min(cells(cell_y_), rows_ / 2);
  for (std::size_t row = first_row_; row < end_row_; ++row) {
    if (row < up || row >= rows_ - up) {
      close_span(row, 0, columns_);
    } else {
      close_span(row, 0, across);
      close_span(row, columns_ - across, across);
    }
  }
}

void OpenCells::close_span(std::size_t row, std::size_t first, std::size_t count) {
  std::size_t cell = (row - first_row_) * columns_ + first;
  while (count > 0) {
    const std::size_t shift = cell % 64;
    const std::size_t taken = std::min(count, 64 - shift);
    const std::uint64_t mask = (taken == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << taken) - 1) << shift;
    std::uint64_t& word = bits_[cell / 64];
    open_ -= static_cast<std::size_t>(std::popcount(mask & ~word));
    word |= mask;
    cell += taken;
    count -= taken;
  }
}

// Closes columns [first, last) of a row, whole numbers; across periodic sides they may lie up to a width outside.
void OpenCells::close_columns(double row, double first, double last) {
  const auto columns = static_cast<double>(columns_);
  const auto close = [&](double a, double b) {
    if (b > a) close_span(static_cast<std::size_t>(row), static_cast<std::size_t>(a), static_cast<std::size_t>(b - a));
  };
  close(std::max(0.0, first), std::min(columns, last));
  if (!box_.periodic_x()) return;
  close(std::max(0.0, first + columns), std::min(columns, last + columns));
  close(std::max(0.0, first - columns), std::min(columns, last - columns));
}

void OpenCells::close_around(double x, double y, double radius) {
  const auto rows = static_cast<double>(rows_);
  const double reach = radius + smallest_;
  // A fixed disk may be far wider than the box; beyond sides that are not periodic there are no rows to close.
  const double first = box_.periodic_y() ? -HUGE_VAL : 0.0;
  const double end = box_.periodic_y() ? HUGE_VAL : rows;
  const double low = std::max(first, std::ceil((y - reach) / cell_y_ + cell_margin));
  const double high = std::min(end, std::floor((y + reach) / cell_y_ - cell_margin));
  for (double row = low; row < high; row += 1.0) {
    // A cell is closed if its farthest corner is within reach.
    const double dy = std::max(std::abs(row * cell_y_ - y), std::abs((row + 1.0) * cell_y_ - y));
    const double half_squared = reach * reach - dy * dy;
    const bool outside = row < 0.0 || row >= rows;
    if (half_squared <= 0.0 || (outside && !box_.periodic_y())) continue;
    const double half = std::sqrt(half_squared);
    const double wrapped = row < 0.0 ? row + rows : (row >= rows ? row - rows : row);
    if (wrapped < static_cast<double>(first_row_) || wrapped >= static_cast<double>(end_row_)) continue;
    close_columns(wrapped, std::ceil((x - half) / cell_x_ + cell_margin),
                  std::floor((x + half) / cell_x_ - cell_margin));
  }
}

bool OpenCells::list_due(std::size_t open) const {
  return open <= std::max(listed_per_disk * disks_, least_listed);
}

// The open cells of a row, from left to right.
void OpenCells::read_row(std::size_t row, std::vector<Voxel>& open) const {
  open.clear();
  const std::size_t begin = (row - first_row_) * columns_;
  const std::size_t end = begin + columns_;
  for (std::size_t word = begin / 64; 64 * word < end; ++word) {
    for (std::uint64_t rest = ~bits_[word]; rest != 0; rest &= rest - 1) {
      const std::size_t cell = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
      if (cell < begin || cell >= end) continue;
      open.push_back({static_cast<std::uint32_t>(cell - begin), static_cast<std::uint32_t>(row)});
    }
  }
}

VoxelList OpenCells::list() {
  constexpr std::size_t side = VoxelList::tile;
  std::vector<Voxel> open;
  reserve_in_huge_pages(open, open_);
  std::array<std::vector<Voxel>, side> row;
  std::size_t given_back = 0;  // words
  for (std::size_t first = first_row_; first < end_row_; first += side) {
    std::array<std::size_t, side> next{};
    for (std::size_t r = 0; r < side; ++r) {
      row[r].clear();
      if (first + r < end_row_) read_row(first + r, row[r]);
    }
    const std::size_t read = std::min(first + side, end_row_) - first_row_;
    if (read * columns_ / 64 > given_back + words_given_back) {
      give_back_pages(bits_, given_back, read * columns_ / 64);
      given_back = read * columns_ / 64;
    }
    for (;;) {
      std::size_t tile = columns_;
      for (std::size_t r = 0; r < side; ++r) {
        if (next[r] < row[r].size()) tile = std::min<std::size_t>(tile, row[r][next[r]].column / side);
      }
      if (tile == columns_) break;
      for (std::size_t r = 0; r < side; ++r) {
        while (next[r] < row[r].size() && row[r][next[r]].column / side == tile) open.push_back(row[r][next[r]++]);
      }
    }
  }
  return {box_, smallest_, disks_, columns_, rows_, std::move(open), region_};
}

}  // namespace carom
