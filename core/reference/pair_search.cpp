#include "core/reference/pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/disks/cell_index.hpp"
#include "core/physics/disk_pair.hpp"
#include "core/reference/cell_neighbours.hpp"

namespace carom {

namespace {

struct UniformGrid {
  std::size_t columns = 1, rows = 1;
  std::vector<std::uint32_t> start;    // of each cell in members, columns * rows + 1 entries
  std::vector<std::uint32_t> members;  // storage indices, cell by cell
};

std::size_t cell_of(double coordinate, double length, std::size_t cells) {
  return cell_index(coordinate / length * static_cast<double>(cells), cells);
}

// Cells no smaller than the largest diameter, and no more than about one a disk.
UniformGrid make_grid(const Disks& d, const Domain& box) {
  UniformGrid grid;
  const double diameter = 2.0 * largest_radius(d);
  const double most = std::sqrt(static_cast<double>(d.size())) + 1.0;
  grid.columns = static_cast<std::size_t>(cells_along(box.width, diameter, most));
  grid.rows = static_cast<std::size_t>(cells_along(box.height, diameter, most));
  grid.start.assign(grid.columns * grid.rows + 1, 0);
  std::vector<std::uint32_t> cell(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    cell[i] = static_cast<std::uint32_t>(cell_of(d.y[i], box.height, grid.rows) * grid.columns +
                                         cell_of(d.x[i], box.width, grid.columns));
    ++grid.start[cell[i]];
  }
  for (std::size_t c = 1; c < grid.start.size(); ++c) grid.start[c] += grid.start[c - 1];
  // Each cell from its end to its start: its disks are then in their order, and no list of places is needed.
  grid.members.resize(d.size());
  for (std::size_t i = d.size(); i-- > 0;) grid.members[--grid.start[cell[i]]] = static_cast<std::uint32_t>(i);
  return grid;
}

bool touch(const Disks& d, const Domain& box, std::size_t i, std::size_t j) {
  return touches(nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box), d.radius_of(i) + d.radius_of(j));
}

void sort_by_id(std::vector<Pair>& pairs, const Disks& d) {
  std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return d.id[a.i1] != d.id[b.i1] ? d.id[a.i1] < d.id[b.i1] : d.id[a.i2] < d.id[b.i2];
  });
}

// Calls use(i, j), the smaller id first, for the touching pairs of which the disk in the earlier cell lies in this row
// of the grid.
template <class Use>
void for_pairs_of_row(const UniformGrid& grid, std::size_t row, const Disks& d, const Domain& box, Use use) {
  const auto use_pairs_between = [&](std::size_t home, std::size_t other) {
    if (other < home) return;  // they are found from there
    for (std::uint32_t a = grid.start[home]; a < grid.start[home + 1]; ++a) {
      for (std::uint32_t b = other == home ? a + 1 : grid.start[other]; b < grid.start[other + 1]; ++b) {
        std::uint32_t i = grid.members[a];
        std::uint32_t j = grid.members[b];
        if (d.id[j] < d.id[i]) std::swap(i, j);
        if (touch(d, box, i, j)) use(i, j);
      }
    }
  };
  const CellNeighbours rows(row, grid.rows, box.periodic_y());
  for (std::size_t column = 0; column < grid.columns; ++column) {
    const std::size_t home = row * grid.columns + column;
    if (grid.start[home] == grid.start[home + 1]) continue;
    const CellNeighbours columns(column, grid.columns, box.periodic_x());
    for (const std::size_t r : rows) {
      // Across the bottom or the top of a sheared box disks of any column may be near.
      const bool across = grid.rows <= 3 || (r != row && r + 1 != row && r != row + 1);
      if (across && box.shear.acts()) {
        for (std::size_t c = 0; c < grid.columns; ++c) use_pairs_between(home, r * grid.columns + c);
        continue;
      }
      for (const std::size_t c : columns) use_pairs_between(home, r * grid.columns + c);
    }
  }
}

}  // namespace

std::vector<Pair> find_touching_pairs(const Disks& d, const Domain& box) {
  std::vector<Pair> pairs;
  if (d.size() < 2) return pairs;
  const UniformGrid grid = make_grid(d, box);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for_pairs_of_row(grid, row, d, box, [&](std::uint32_t i, std::uint32_t j) { pairs.push_back({i, j}); });
  }
  sort_by_id(pairs, d);
  return pairs;
}

std::vector<Overlap> deepest_of_touching_pairs(const Disks& d, const Domain& box, const BlockRunner& run,
                                               const std::function<double(std::uint32_t, std::uint32_t)>& overlap) {
  if (d.size() < 2) return {};
  const UniformGrid grid = make_grid(d, box);
  std::vector<Overlap> deepest(grid.rows);
  run(grid.rows, [&](std::size_t row) {
    for_pairs_of_row(grid, row, d, box, [&](std::uint32_t i, std::uint32_t j) {
      deepest[row].see({overlap(i, j), d.id[i], d.id[j]});
    });
  });
  return deepest;
}

}  // namespace carom
