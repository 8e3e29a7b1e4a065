#include "parallel/stepping/stepping_cells.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/cells/crowding.hpp"
#include "parallel/stepping/sort_rule.hpp"

namespace carom {

namespace {

// If disks are crowded, most cells are empty, and each sort clears and scans all of them; with fewer cells, a search
// tests more disks. The total time is least if the number of cells is increased by this factor times the root of the
// crowding; 0.7 to 2.5 are about as good, for clusters and piles 3 to 100 times as dense as their box. With cells in
// proportion to the crowding, a cluster in a gas takes more than twice as long, and disks beside sources and sinks,
// which are sorted in every step, 2.5 times.
constexpr double cells_a_root = 1.5;

double cells_for_crowded(double crowded) {
  return std::min(crowded, cells_a_root * std::sqrt(crowded));
}

}  // namespace

void make_stepping_cells(const Disks& d, const Domain& box, std::vector<std::size_t>& count, CellGrid& grid) {
  const double largest = largest_radius(d);
  count_classes(d, largest, count);
  const bool may_be_crowded = is_bounded_by_disks(box, largest, count, stepping_margin);
  const double denser = may_be_crowded ? cells_for_crowded(crowding(d, box)) : 1.0;
  make_grid(box, largest, count, grid, stepping_margin, denser);
}

}  // namespace carom
