// Counts of pairs of disks by their distance, for the pair correlation g(r).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/block_runner.hpp"
#include "core/base/types.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/pair_counts.hpp"

namespace carom {

// Distances from 0 to r_max in equal bins: bin k holds k r_max / bins <= r < (k + 1) r_max / bins.
// Precondition: r_max is at most half of each periodic side.
struct DistanceBins {
  double r_max = 0.0;  // length
  std::size_t bins = 0;
  double wall_margin = 0.0;  // see DistancePlan
};

// The disks, sorted into rows across the box and into cells along each row. A row is r_max / 2 high or more, so
// partners are in the same row or the two above and below, in cells that a chord of the circle of radius r_max reaches.
// A periodic box too low for that has one row.
class DistanceCells {
 public:
  struct Span {
    std::size_t begin, end;
  };

  // box: at the time of the disks.
  DistanceCells(const Disks& disks, const Domain& box, const DistanceBins& bins);

  std::size_t rows() const { return rows_; }
  // Blocks of rows, which can be counted independently.
  std::size_t blocks() const { return (rows_ + rows_a_block() - 1) / rows_a_block(); }
  Span rows_of(std::size_t block) const {
    return {block * rows_a_block(), std::min(rows_, (block + 1) * rows_a_block())};
  }
  std::size_t centres() const { return centres_; }

  // A disk's place is its position in the order of cells. By place: the storage index; whether the disk is a centre (1)
  // from which pairs are counted.
  const std::vector<std::uint32_t>& disks() const { return disk_; }
  const std::vector<std::uint8_t>& are_centres() const { return centre_; }

  // Adds to counts[k] the ordered pairs (i, j) in bin k whose first disk is a centre. A pair belongs to rows [begin,
  // end) if its disk in the lower row, or the first of two in one row, lies there. Counts are integers: rows may be
  // counted separately, in any order, and added.
  void count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const;

  // Calls add(k, p, q) once for each pair of places in bin k that belongs to rows [begin, end), in an order that
  // depends only on the order of storage.
  template <class Add>
  void visit(std::size_t begin, std::size_t end, const Add& add) const;

 private:
  // The displacement of an image.
  struct Shift {
    double x, y;  // length; 0, or a period
  };
  static constexpr std::size_t rows_ahead = 2;
  static constexpr std::size_t most_blocks = 256;  // each has its own sums
  static constexpr std::size_t run_length = 256;   // of places whose distances from one place are computed together

  std::size_t rows_a_block() const { return (rows_ + most_blocks - 1) / most_blocks; }
  std::size_t cell_at(std::size_t row, double x) const;
  double chord(std::size_t place, std::size_t rows_above, std::size_t row) const;
  template <class Add>
  void visit_row_above(std::size_t place, std::size_t row, std::size_t rows_above, const Add& add) const;
  template <class Add>
  void visit_own_row(std::size_t place, std::size_t row, double shift_y, const Add& add) const;
  template <class Distance2, class Add>
  void visit_run(std::size_t place, std::size_t begin, std::size_t end, const Distance2& distance2, Add add) const;
  template <class Add>
  void visit_shifted(std::size_t place, std::size_t begin, std::size_t end, Shift shift, const Add& add) const;
  template <class Add>
  void visit_sheared(std::size_t place, std::size_t begin, std::size_t end, const Add& add) const;

  DistanceBins bins_;
  Domain box_;
  std::size_t rows_ = 1, columns_ = 1;
  double row_height_ = 0.0;  // length
  double margin_ = 0.0;      // a generous bound on the rounding of positions; length
  std::size_t centres_ = 0;
  std::vector<std::uint32_t> start_;  // of each cell among the places, one more than cells
  std::vector<double> x_, y_;         // by place; length
  std::vector<std::uint32_t> disk_;
  std::vector<std::uint8_t> centre_;
};

// distance2(q): squared distance of place q from this one; length^2. The bins of a whole run are computed first,
// several at a time in vector registers. add is taken by value, so that its references stay in registers.
template <class Distance2, class Add>
void DistanceCells::visit_run(std::size_t place, std::size_t begin, std::size_t end, const Distance2& distance2,
                              Add add) const {
  const double r_max2 = bins_.r_max * bins_.r_max;
  const auto bins = static_cast<std::int64_t>(bins_.bins);
  const double bins_per_length = static_cast<double>(bins) / bins_.r_max;
  std::array<double, run_length> r2, in_bins;
  for (std::size_t first = begin; first < end; first += run_length) {
    const std::size_t n = std::min(run_length, end - first);
    for (std::size_t k = 0; k < n; ++k) {
      r2[k] = distance2(first + k);
      in_bins[k] = std::sqrt(r2[k]) * bins_per_length;
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (!(r2[k] < r_max2)) continue;
      const auto bin = static_cast<std::int64_t>(in_bins[k]);
      if (bin < bins) add(static_cast<std::size_t>(bin), place, first + k);
    }
  }
}

// With one image of each disk: since r_max is at most half a period, no other image is as near, and no pair comes
// twice.
template <class Add>
void DistanceCells::visit_shifted(std::size_t place, std::size_t begin, std::size_t end, Shift shift,
                                  const Add& add) const {
  const double x = x_[place];
  const double y = y_[place];
  const double* const xs = x_.data();
  const double* const ys = y_.data();
  const auto distance2 = [=](std::size_t q) {
    const double dx = (xs[q] - x) + shift.x;
    const double dy = (ys[q] - y) + shift.y;
    return dx * dx + dy * dy;
  };
  visit_run(place, begin, end, distance2, add);
}

template <class Add>
void DistanceCells::visit_sheared(std::size_t place, std::size_t begin, std::size_t end, const Add& add) const {
  const auto distance2 = [&](std::size_t q) {
    const Vec2 apart = nearest_image(Vec2{x_[q] - x_[place], y_[q] - y_[place]}, box_);
    return apart.x * apart.x + apart.y * apart.y;
  };
  visit_run(place, begin, end, distance2, add);
}

// The row rows_above above that of the place, across a periodic side if need be.
template <class Add>
void DistanceCells::visit_row_above(std::size_t place, std::size_t row, std::size_t rows_above, const Add& add) const {
  const std::size_t other = row + rows_above;
  if (other >= rows_ && !box_.periodic_y()) return;
  const bool above = other >= rows_;
  const std::size_t stored = above ? other - rows_ : other;
  const std::size_t first = start_[stored * columns_];
  const std::size_t last = start_[(stored + 1) * columns_];
  if (above && box_.shear.acts()) return visit_sheared(place, first, last, add);
  const double half = chord(place, rows_above, row);
  if (half < 0.0) return;
  const double low = x_[place] - half;
  const double high = x_[place] + half;
  const double shift_y = above ? box_.height : 0.0;
  visit_shifted(place, start_[cell_at(stored, low)], start_[cell_at(stored, high) + 1], {0.0, shift_y}, add);
  if (!box_.periodic_x()) return;
  const double period = box_.width;
  if (low < 0.0) visit_shifted(place, start_[cell_at(stored, low + period)], last, {-period, shift_y}, add);
  if (high >= period) {
    visit_shifted(place, first, start_[cell_at(stored, high - period) + 1], {period, shift_y}, add);
  }
}

// With the places after this one in its row.
template <class Add>
void DistanceCells::visit_own_row(std::size_t place, std::size_t row, double shift_y, const Add& add) const {
  const double reach = bins_.r_max + margin_;
  const std::size_t first = place + 1;
  const std::size_t last = start_[(row + 1) * columns_];
  const double high = x_[place] + reach;
  visit_shifted(place, first, start_[cell_at(row, high) + 1], {0.0, shift_y}, add);
  if (!box_.periodic_x()) return;
  const double period = box_.width;
  const double low = x_[place] - reach + period;
  if (low < period) {
    visit_shifted(place, std::max<std::size_t>(first, start_[cell_at(row, low)]), last, {-period, shift_y}, add);
  }
  // Images to the left come after the place only if they are in the same cell.
  if (high >= period) {
    visit_shifted(place, first, start_[cell_at(row, high - period) + 1], {period, shift_y}, add);
  }
}

template <class Add>
void DistanceCells::visit(std::size_t begin, std::size_t end, const Add& add) const {
  const bool around = box_.periodic_y() && rows_ == 1;
  for (std::size_t row = begin; row < end; ++row) {
    const std::size_t last = start_[(row + 1) * columns_];
    for (std::size_t place = start_[row * columns_]; place < last; ++place) {
      if (around && box_.shear.acts()) {
        visit_sheared(place, place + 1, last, add);
        continue;
      }
      visit_own_row(place, row, 0.0, add);
      if (around) {
        visit_own_row(place, row, box_.height, add);
        visit_own_row(place, row, -box_.height, add);
        continue;
      }
      for (std::size_t k = 1; k <= rows_ahead; ++k) visit_row_above(place, row, k, add);
    }
  }
}

// The same for any runner, since integers add up to the same in any order.
PairCounts count_pairs(const Disks& disks, const Domain& box, const DistanceBins& bins,
                       const BlockRunner& run = run_in_order);

// Area of the region of centres from which pairs are counted; length^2. It keeps a margin from sides that are not
// periodic (at their places at the time of the box), so that the whole circle of radius r_max lies where centres can
// be.
double area_of_centres(const Domain& box, const DistanceBins& bins);

}  // namespace carom
