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

// Where centres may be along an axis: the margin away from both sides, wherever those are that move; length.
struct Extent {
  double low = 0.0, high = 0.0, length = 0.0;
  bool holds(double c) const { return c >= low && c <= high; }
};

Extent extent_of_centres(const Domain& box, bool along_x, double margin) {
  const double side = along_x ? box.width : box.height;
  if (along_x ? box.periodic_x() : box.periodic_y()) return {0.0, side, side};
  const double first = box.place(along_x ? Side::left : Side::bottom).inset;
  const double last = box.place(along_x ? Side::right : Side::top).inset;
  return {margin + first, side - margin - last, std::max(0.0, side - 2.0 * margin - (first + last))};
}

}  // namespace

DistanceCells::Axis DistanceCells::axis(double length, bool periodic, std::size_t disks) const {
  const auto cells = static_cast<std::size_t>(cells_along(length, bins_.r_max, most_cells(disks)));
  return {length, periodic, cells < 3 ? 1 : cells};
}

DistanceCells::DistanceCells(const Disks& d, const Domain& box, const DistanceBins& bins)
    : bins_(bins),
      box_(box),
      x_(axis(box.width, box.periodic_x(), d.size())),
      y_(axis(box.height, box.periodic_y(), d.size())),
      rows_(y_.cells),
      places_(d.size()) {
  // Of the one row of a sheared box, what lies above is the row itself, displaced: all pairs.
  if (box.shear.acts() && y_.cells == 1) x_.cells = 1;
  start_.assign(x_.cells * y_.cells + 1, 0);
  std::vector<std::uint32_t> cell(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    cell[i] = static_cast<std::uint32_t>(cell_of(d.y[i], y_.length, y_.cells) * x_.cells +
                                         cell_of(d.x[i], x_.length, x_.cells));
    ++start_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  const Extent along_x = extent_of_centres(box, true, bins_.wall_margin);
  const Extent along_y = extent_of_centres(box, false, bins_.wall_margin);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const bool centre = (x_.periodic || along_x.holds(d.x[i])) && (y_.periodic || along_y.holds(d.y[i]));
    places_[next[cell[i]]++] = {d.x[i], d.y[i], centre ? 1U : 0U, static_cast<std::uint32_t>(i)};
    centres_ += centre ? 1U : 0U;
  }
}

// Half of the cells around a cell, so that every two neighbours meet once: the next in its row and three of the row
// above, round the corner of a periodic side.
std::size_t DistanceCells::neighbours(std::size_t row, std::size_t column, Neighbours& cells) const {
  std::size_t count = 0;
  const bool right = column + 1 < x_.cells || (x_.periodic && x_.cells > 1);
  const bool left = column > 0 || (x_.periodic && x_.cells > 1);
  const std::size_t next = column + 1 < x_.cells ? column + 1 : 0;
  const std::size_t before = column > 0 ? column - 1 : x_.cells - 1;
  if (right) cells[count++] = row * x_.cells + next;
  if (row + 1 == y_.cells && !(y_.periodic && y_.cells > 1)) return count;
  if (row + 1 == y_.cells && box_.shear.acts()) return displaced_above(column, cells, count);
  const std::size_t above = (row + 1 < y_.cells ? row + 1 : 0) * x_.cells;
  if (left) cells[count++] = above + before;
  cells[count++] = above + column;
  if (right) cells[count++] = above + next;
  return count;
}

// The lowest row has its images above displaced by the offset: of the cells there, those that come within a cell of
// this column, and of two whose edge rounding might miss, both. Adds them to the first `count`.
std::size_t DistanceCells::displaced_above(std::size_t column, Neighbours& cells, std::size_t count) const {
  constexpr double rounding = 1e-9;  // of a cell; a column's number has ten digits before it at most
  const double middle = static_cast<double>(column) - box_.shear.offset / x_.length * static_cast<double>(x_.cells);
  const auto first = static_cast<std::ptrdiff_t>(std::floor(middle - 1.0 - rounding));
  const auto last = static_cast<std::ptrdiff_t>(std::floor(middle + 2.0 + rounding));
  const auto columns = static_cast<std::ptrdiff_t>(x_.cells);
  const std::ptrdiff_t end = std::min(last + 1, first + columns);
  for (std::ptrdiff_t c = first; c < end; ++c) {
    cells[count++] = static_cast<std::size_t>(((c % columns) + columns) % columns);
  }
  return count;
}

void DistanceCells::count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const {
  visit(begin, end, [&](std::size_t bin, const Place& p, const Place& q) { counts[bin] += p.centre + q.centre; });
}

PairCounts count_pairs(const Disks& disks, const Domain& box, const DistanceBins& bins, const BlockRunner& run) {
  const DistanceCells cells(disks, box, bins);
  std::vector<std::vector<Count>> parts(cells.blocks());
  run(parts.size(), [&](std::size_t b) {
    parts[b].assign(bins.bins, 0);
    cells.count(cells.rows_of(b).begin, cells.rows_of(b).end, parts[b]);
  });
  PairCounts result{cells.centres(), std::vector<Count>(bins.bins, 0)};
  for (const std::vector<Count>& part : parts) {
    for (std::size_t k = 0; k < part.size(); ++k) result.counts[k] += part[k];
  }
  return result;
}

double area_of_centres(const Domain& box, const DistanceBins& bins) {
  return extent_of_centres(box, true, bins.wall_margin).length * extent_of_centres(box, false, bins.wall_margin).length;
}

}  // namespace carom
