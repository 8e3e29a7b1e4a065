// The disks that may collide with a disk in a window: a grid over their positions at its start.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disks/cell_index.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/reference/cell_neighbours.hpp"

namespace carom {

// Cells are no smaller than the largest diameter plus twice `travel` (length): disks that move by no more than `travel`
// collide only with disks of their own cell and the eight around it. If fewer than three such cells fit along a side,
// there is one cell.
class Neighbourhood {
 public:
  Neighbourhood(const Disks& disks, const Domain& box, double travel) : box_(box) {
    const double cell = 2.0 * largest_radius(disks) + 2.0 * travel;
    columns_ = cells_of_side(box.width, cell, disks.size());
    rows_ = cells_of_side(box.height, cell, disks.size());
    cells_.resize(columns_ * rows_);
    home_.resize(disks.size());
    for (std::size_t i = 0; i < disks.size(); ++i) {
      home_[i] = {cell_of(disks.x[i], box.width, columns_), cell_of(disks.y[i], box.height, rows_)};
      cells_[home_[i].row * columns_ + home_[i].column].push_back(static_cast<std::uint32_t>(i));
    }
  }

  // Calls found(j) for every disk j other than i in the cells around that of disk i.
  template <class Found>
  void visit(std::uint32_t i, Found&& found) const {
    for (const std::size_t row : CellNeighbours(home_[i].row, rows_, box_.periodic_y())) {
      // Across the bottom or the top of a sheared box, neighbours may be in any column.
      const bool across = rows_ <= 3 || (row != home_[i].row && row + 1 != home_[i].row && row != home_[i].row + 1);
      if (across && box_.shear.acts()) {
        visit_row(row, i, found);
        continue;
      }
      for (const std::size_t column : CellNeighbours(home_[i].column, columns_, box_.periodic_x())) {
        for (const std::uint32_t j : cells_[row * columns_ + column]) {
          if (j != i) found(j);
        }
      }
    }
  }

 private:
  template <class Found>
  void visit_row(std::size_t row, std::uint32_t i, Found& found) const {
    for (std::size_t column = 0; column < columns_; ++column) {
      for (const std::uint32_t j : cells_[row * columns_ + column]) {
        if (j != i) found(j);
      }
    }
  }

  struct Home {
    std::size_t column, row;
  };

  static std::size_t cells_of_side(double length, double cell, std::size_t disks) {
    const double cells = cells_along(length, cell, std::sqrt(static_cast<double>(disks)) + 1.0);
    return cells < 3.0 ? 1 : static_cast<std::size_t>(cells);
  }

  static std::size_t cell_of(double coordinate, double length, std::size_t cells) {
    return cell_index(coordinate / length * static_cast<double>(cells), cells);
  }

  Domain box_;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<Home> home_;
};

}  // namespace carom
