#include "core/reference/pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/disks/cell_axis.hpp"
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

// The grid of disks disk(0) to disk(n - 1): cells no smaller than their largest diameter, and at most about one for
// each disk.
template <class Disk>
UniformGrid make_grid(const Disks& d, const Domain& box, double largest_radius, std::size_t n, Disk disk) {
  UniformGrid grid;
  const double diameter = 2.0 * largest_radius;
  const double most = std::sqrt(static_cast<double>(n)) + 1.0;
  grid.columns = static_cast<std::size_t>(cells_along(box.width, diameter, most));
  grid.rows = static_cast<std::size_t>(cells_along(box.height, diameter, most));
  grid.start.assign(grid.columns * grid.rows + 1, 0);
  std::vector<std::uint32_t> cell(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t i = disk(k);
    cell[k] = static_cast<std::uint32_t>(cell_of(d.y[i], box.height, grid.rows) * grid.columns +
                                         cell_of(d.x[i], box.width, grid.columns));
    ++grid.start[cell[k]];
  }
  for (std::size_t c = 1; c < grid.start.size(); ++c) grid.start[c] += grid.start[c - 1];
  // Counting sort. Each cell is filled from its end, so its disks stay in order and no separate list of positions is
  // needed.
  grid.members.resize(n);
  for (std::size_t k = n; k-- > 0;) grid.members[--grid.start[cell[k]]] = disk(k);
  return grid;
}

UniformGrid make_grid(const Disks& d, const Domain& box) {
  return make_grid(d, box, largest_radius(d), d.size(), [](std::size_t k) { return static_cast<std::uint32_t>(k); });
}

bool touch(const Disks& d, const Domain& box, std::size_t i, std::size_t j) {
  return touches(nearest_distance2({d.x[j] - d.x[i], d.y[j] - d.y[i]}, box), d.radius_of(i) + d.radius_of(j));
}

void sort_by_id(std::vector<Pair>& pairs, const Disks& d) {
  std::sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return d.id[a.i1] != d.id[b.i1] ? d.id[a.i1] < d.id[b.i1] : d.id[a.i2] < d.id[b.i2];
  });
}

// Calls use(i, j), the smaller id first, for the touching pairs whose disk in the earlier cell lies in this row of the
// grid.
template <class Use>
void for_pairs_of_row(const UniformGrid& grid, std::size_t row, const Disks& d, const Domain& box, Use use) {
  const auto use_pairs_between = [&](std::size_t home, std::size_t other) {
    if (other < home) return;  // such pairs are found from the other cell
    for (std::uint32_t a = grid.start[home]; a < grid.start[home + 1]; ++a) {
      for (std::uint32_t b = other == home ? a + 1 : grid.start[other]; b < grid.start[other + 1]; ++b) {
        const std::uint32_t i = grid.members[a], j = grid.members[b];
        if (touch(d, box, i, j)) d.id[j] < d.id[i] ? use(j, i) : use(i, j);
      }
    }
  };
  const CellNeighbours rows(row, grid.rows, box.periodic_y());
  for (std::size_t column = 0; column < grid.columns; ++column) {
    const std::size_t home = row * grid.columns + column;
    if (grid.start[home] == grid.start[home + 1]) continue;
    const CellNeighbours columns(column, grid.columns, box.periodic_x());
    for (const std::size_t r : rows) {
      // Across the bottom or the top of a sheared box, neighbours may be in any column.
      const bool across = grid.rows <= 3 || (r != row && r + 1 != row && r != row + 1);
      if (across && box.shear.acts()) {
        for (std::size_t c = 0; c < grid.columns; ++c) use_pairs_between(home, r * grid.columns + c);
        continue;
      }
      for (const std::size_t c : columns) use_pairs_between(home, r * grid.columns + c);
    }
  }
}

// Disks whose radii differ by less than a factor of four. A grid for each class keeps the number of disks in a cell
// small for any mixture of sizes.
struct SizeClass {
  double largest_radius = 0.0;  // length
  UniformGrid grid;
};

// The classes from the largest disks to the smallest; empty ones are left out.
std::vector<SizeClass> size_classes(const Disks& d, const Domain& box) {
  constexpr double ratio = 4.0;
  double largest = largest_radius(d);
  const double smallest = smallest_radius(d);
  std::vector<SizeClass> classes;
  if (smallest * ratio > largest) {
    classes.push_back({largest, make_grid(d, box)});
    return classes;
  }
  std::vector<std::uint32_t> members;
  for (; largest >= smallest; largest /= ratio) {
    members.clear();
    for (std::uint32_t i = 0; i < d.size(); ++i) {
      if (d.radius[i] <= largest && d.radius[i] * ratio > largest) members.push_back(i);
    }
    if (members.empty()) continue;
    classes.push_back({largest, make_grid(d, box, largest, members.size(), [&](std::size_t k) { return members[k]; })});
  }
  return classes;
}

// As for_pairs_of_row, for the pairs of disk i with disks of another class.
template <class Use>
void for_pairs_across(const SizeClass& other, std::uint32_t i, const Disks& d, const Domain& box, Use use) {
  const auto axis = [](double length, bool periodic, std::size_t cells) {
    return CellAxis{length, periodic, static_cast<std::int64_t>(cells), static_cast<double>(cells) / length};
  };
  // Each cell only once, even if the range reaches around a periodic box.
  const auto near = [&](double c, const CellAxis& along) {
    const double reach = d.radius_of(i) + other.largest_radius;
    const CellAxis::Span span = along.span(c - reach, c + reach);
    return CellAxis::Span{span.first, std::min(span.last, span.first + along.cells - 1)};
  };
  const UniformGrid& grid = other.grid;
  const CellAxis x = axis(box.width, box.periodic_x(), grid.columns), y = axis(box.height, box.periodic_y(), grid.rows);
  const CellAxis::Span rows = near(d.y[i], y);
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    // As in for_pairs_of_row.
    const bool across = y.in_box(row) != row || rows.last - rows.first + 1 == y.cells;
    const CellAxis::Span columns = across && box.shear.acts() ? CellAxis::Span{0, x.cells - 1} : near(d.x[i], x);
    for (std::int64_t column = columns.first; column <= columns.last; ++column) {
      const auto cell = static_cast<std::size_t>(y.in_box(row) * x.cells + x.in_box(column));
      for (std::uint32_t b = grid.start[cell]; b < grid.start[cell + 1]; ++b) {
        const std::uint32_t j = grid.members[b];
        if (touch(d, box, i, j)) d.id[j] < d.id[i] ? use(j, i) : use(i, j);
      }
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
  const std::vector<SizeClass> classes = size_classes(d, box);
  std::vector<Overlap> deepest;
  for (auto own = classes.begin(); own != classes.end(); ++own) {
    const UniformGrid& grid = own->grid;
    const std::size_t first = deepest.size();
    deepest.resize(first + grid.rows);
    run(grid.rows, [&](std::size_t row) {
      const auto see = [&](std::uint32_t i, std::uint32_t j) {
        deepest[first + row].raise_to({overlap(i, j), d.id[i], d.id[j]});
      };
      for_pairs_of_row(grid, row, d, box, see);
      for (auto smaller = own + 1; smaller != classes.end(); ++smaller) {
        for (std::uint32_t a = grid.start[row * grid.columns]; a < grid.start[(row + 1) * grid.columns]; ++a)
          for_pairs_across(*smaller, grid.members[a], d, box, see);
      }
    });
  }
  return deepest;
}

}  // namespace carom
