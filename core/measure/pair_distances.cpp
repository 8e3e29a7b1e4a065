#include "core/measure/pair_distances.hpp"

#include <algorithm>
#include <cmath>

#include "core/disks/cell_index.hpp"

namespace carom {

namespace {

// About so many disks in a cell: the cells that a chord reaches contain a few disks too many at each end.
constexpr std::size_t disks_a_cell = 2;

// The number of rows: each r_max / rows_ahead high or more, and no more than disks along a side. In a periodic box the
// rows above and below a row must be different ones.
std::size_t rows_for(const Domain& box, double r_max, std::size_t rows_ahead, std::size_t disks) {
  const double most = std::sqrt(static_cast<double>(disks)) + 1.0;
  const auto rows = static_cast<std::size_t>(cells_along(box.height, r_max / static_cast<double>(rows_ahead), most));
  return box.periodic_y() && rows < 2 * rows_ahead + 1 ? 1 : rows;
}

// The range of centres along an axis: away from both sides, at their present places, by the margin; length.
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

DistanceCells::DistanceCells(const Disks& d, const Domain& box, const DistanceBins& bins)
    : bins_(bins),
      box_(box),
      rows_(rows_for(box, bins.r_max, rows_ahead, d.size())),
      columns_(d.size() / (disks_a_cell * rows_) + 1),
      row_height_(box.height / static_cast<double>(rows_)),
      margin_(1e-9 * (box.width + box.height)),
      x_(d.size()),
      y_(d.size()),
      disk_(d.size()),
      centre_(d.size()) {
  start_.assign(rows_ * columns_ + 1, 0);
  std::vector<std::uint32_t> cell(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    const std::size_t row = cell_index(d.y[i] / box.height * static_cast<double>(rows_), rows_);
    cell[i] = static_cast<std::uint32_t>(cell_at(row, d.x[i]));
    ++start_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  const Extent along_x = extent_of_centres(box, true, bins_.wall_margin);
  const Extent along_y = extent_of_centres(box, false, bins_.wall_margin);
  for (std::size_t i = 0; i < d.size(); ++i) {
    const bool centre = (box.periodic_x() || along_x.holds(d.x[i])) && (box.periodic_y() || along_y.holds(d.y[i]));
    const std::uint32_t place = next[cell[i]]++;
    x_[place] = d.x[i];
    y_[place] = d.y[i];
    disk_[place] = static_cast<std::uint32_t>(i);
    centre_[place] = centre ? 1 : 0;
    centres_ += centre ? 1U : 0U;
  }
}

// The cell of a row that holds x; outside the box, the nearest one.
std::size_t DistanceCells::cell_at(std::size_t row, double x) const {
  return row * columns_ + cell_index(x / box_.width * static_cast<double>(columns_), columns_);
}

// Half the widest chord, within the row rows_above above, of the circle around a place; negative if the row is out of
// reach. Disks below the box are in the lowest row, disks above it in the uppermost.
double DistanceCells::chord(std::size_t place, std::size_t rows_above, std::size_t row) const {
  const double edge = static_cast<double>(row + rows_above) * row_height_;
  const double height = std::max(0.0, edge - y_[place] - margin_);
  const double half2 = bins_.r_max * bins_.r_max - height * height;
  return half2 < 0.0 ? -1.0 : std::sqrt(half2) + margin_;
}

void DistanceCells::count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const {
  const std::uint8_t* const centre = centre_.data();
  Count* const counted = counts.data();
  visit(begin, end, [=](std::size_t bin, std::size_t p, std::size_t q) {
    counted[bin] += static_cast<Count>(centre[p]) + centre[q];
  });
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
