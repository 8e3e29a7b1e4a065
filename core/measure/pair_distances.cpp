#include "core/measure/pair_distances.hpp"

#include <algorithm>
#include <cmath>

#include "core/disks/cell_index.hpp"

namespace carom {

namespace {

// Cells without disks cost time and bytes too: about as many cells along a side as disks make sensible.
double most_cells(std::size_t disks) {
  return std::sqrt(static_cast<double>(disks)) + 1.0;
}

std::size_t cell_of(double coordinate, double length, std::size_t cells) {
  return cell_index(coordinate / length * static_cast<double>(cells), cells);
}

// Is a coordinate far enough from the two sides?
bool is_inside(double c, double length, bool periodic, double margin) {
  return periodic || (c >= margin && c <= length - margin);
}

}  // namespace

DistanceCells::Axis DistanceCells::axis(double length, bool periodic, std::size_t disks) const {
  const auto cells = static_cast<std::size_t>(cells_along(length, bins_.r_max, most_cells(disks)));
  return {length, periodic, cells < 3 ? 1 : cells};
}

DistanceCells::DistanceCells(const Disks& d, const Domain& box, const DistanceBins& bins)
    : bins_(bins),
      x_(axis(box.width, box.periodic_x(), d.size())),
      y_(axis(box.height, box.periodic_y(), d.size())),
      rows_(y_.cells),
      start_(x_.cells * y_.cells + 1, 0),
      places_(d.size()) {
  std::vector<std::uint32_t> cell(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    cell[i] = static_cast<std::uint32_t>(cell_of(d.y[i], y_.length, y_.cells) * x_.cells +
                                         cell_of(d.x[i], x_.length, x_.cells));
    ++start_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const bool centre = is_inside(d.x[i], x_.length, x_.periodic, bins_.wall_margin) &&
                        is_inside(d.y[i], y_.length, y_.periodic, bins_.wall_margin);
    places_[next[cell[i]]++] = {d.x[i], d.y[i], centre ? 1U : 0U};
    centres_ += centre ? 1U : 0U;
  }
}

// Half of the cells around a cell, so that every two neighbours meet once: the next in its row and three of the row
// above, round the corner of a periodic side.
std::size_t DistanceCells::neighbours(std::size_t row, std::size_t column, std::array<std::size_t, 4>& cells) const {
  std::size_t count = 0;
  const bool right = column + 1 < x_.cells || (x_.periodic && x_.cells > 1);
  const bool left = column > 0 || (x_.periodic && x_.cells > 1);
  const std::size_t next = column + 1 < x_.cells ? column + 1 : 0;
  const std::size_t before = column > 0 ? column - 1 : x_.cells - 1;
  if (right) cells[count++] = row * x_.cells + next;
  if (row + 1 == y_.cells && !(y_.periodic && y_.cells > 1)) return count;
  const std::size_t above = (row + 1 < y_.cells ? row + 1 : 0) * x_.cells;
  if (left) cells[count++] = above + before;
  cells[count++] = above + column;
  if (right) cells[count++] = above + next;
  return count;
}

// round_corner: the cells may be neighbours across a periodic side. Elsewhere the nearest image is the disk itself, or
// it is further than r_max.
template <bool round_corner>
void DistanceCells::count_between(std::size_t cell, std::size_t other, std::vector<Count>& counts) const {
  const double r_max2 = bins_.r_max * bins_.r_max;
  const double bins_per_length = static_cast<double>(bins_.bins) / bins_.r_max;
  for (std::size_t a = start_[cell]; a < start_[cell + 1]; ++a) {
    const Place p = places_[a];
    for (std::size_t b = cell == other ? a + 1 : start_[other]; b < start_[other + 1]; ++b) {
      const Place& q = places_[b];
      double dx = q.x - p.x;
      double dy = q.y - p.y;
      if constexpr (round_corner) {
        if (x_.periodic) dx = nearest_image(dx, x_.length);
        if (y_.periodic) dy = nearest_image(dy, y_.length);
      }
      const double r2 = dx * dx + dy * dy;
      if (!(r2 < r_max2)) continue;
      const auto bin = static_cast<std::size_t>(std::sqrt(r2) * bins_per_length);
      if (bin < bins_.bins) counts[bin] += p.centre + q.centre;
    }
  }
}

void DistanceCells::count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const {
  std::array<std::size_t, 4> around{};
  for (std::size_t row = begin; row < end; ++row) {
    for (std::size_t column = 0; column < x_.cells; ++column) {
      const std::size_t home = row * x_.cells + column;
      const bool at_side = row + 1 == y_.cells || column == 0 || column + 1 == x_.cells;
      const auto count_with = [&](std::size_t other) {
        at_side ? count_between<true>(home, other, counts) : count_between<false>(home, other, counts);
      };
      count_with(home);
      const std::size_t n = neighbours(row, column, around);
      for (std::size_t k = 0; k < n; ++k) count_with(around[k]);
    }
  }
}

PairCounts count_pairs(const Disks& disks, const Domain& box, const DistanceBins& bins) {
  const DistanceCells cells(disks, box, bins);
  PairCounts result{cells.centres(), std::vector<Count>(bins.bins, 0)};
  cells.count(0, cells.rows(), result.counts);
  return result;
}

double area_of_centres(const Domain& box, const DistanceBins& bins) {
  const double width = box.periodic_x() ? box.width : box.width - 2.0 * bins.wall_margin;
  const double height = box.periodic_y() ? box.height : box.height - 2.0 * bins.wall_margin;
  return width * height;
}

}  // namespace carom
