// How many pairs of disks are how far apart: what the pair correlation g(r) is made of.
#pragma once

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

// The centres, sorted into cells no smaller than r_max, so that all partners are in the 3 x 3 cells around, in a
// sheared box above the uppermost row in up to five cells that its offset says. A side with room for fewer than three
// cells has one; a sheared box as low as that has one in all.
class DistanceCells {
 public:
  struct Place {
    double x, y;         // length
    unsigned centre;     // 1: its surroundings count
    std::uint32_t disk;  // where it is stored
  };

  struct Span {
    std::size_t begin, end;
  };

  // box: at the time of the disks.
  DistanceCells(const Disks& disks, const Domain& box, const DistanceBins& bins);

  std::size_t rows() const { return rows_; }
  // Rows in blocks to be counted apart.
  std::size_t blocks() const { return (rows_ + rows_a_block() - 1) / rows_a_block(); }
  Span rows_of(std::size_t block) const {
    return {block * rows_a_block(), std::min(rows_, (block + 1) * rows_a_block())};
  }
  std::size_t centres() const { return centres_; }

  // Adds to counts[k] the ordered pairs (i, j) in bin k whose first disk is a centre, of which the one in the lower
  // cell lies in rows [begin, end). Integers: rows may be counted apart, in any order, and added.
  void count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const;

  // Calls add(k, p, q) once for each pair of Places in bin k of which the one in the lower cell lies in rows [begin,
  // end), in an order that depends on the order of storage alone.
  template <class Add>
  void visit(std::size_t begin, std::size_t end, const Add& add) const;

 private:
  struct Axis {
    double length = 0.0;
    bool periodic = false;
    std::size_t cells = 1;
  };
  std::size_t rows_a_block() const { return (rows_ + most_blocks - 1) / most_blocks; }
  Axis axis(double length, bool periodic, std::size_t disks) const;
  using Neighbours = std::array<std::size_t, 6>;
  std::size_t neighbours(std::size_t row, std::size_t column, Neighbours& cells) const;
  std::size_t displaced_above(std::size_t column, Neighbours& cells, std::size_t count) const;
  template <bool round_corner, class Add>
  void visit_between(std::size_t cell, std::size_t other, const Add& add) const;

  static constexpr std::size_t most_blocks = 256;  // each has sums of its own
  DistanceBins bins_;
  Domain box_;
  Axis x_, y_;
  std::size_t rows_ = 1;
  std::size_t centres_ = 0;
  std::vector<std::uint32_t> start_;  // of each cell in places_, one more than cells
  std::vector<Place> places_;
};

// round_corner: the cells may be neighbours across a periodic side. Elsewhere the nearest image is the disk itself, or
// it is further than r_max.
template <bool round_corner, class Add>
void DistanceCells::visit_between(std::size_t cell, std::size_t other, const Add& add) const {
  const double r_max2 = bins_.r_max * bins_.r_max;
  const double bins_per_length = static_cast<double>(bins_.bins) / bins_.r_max;
  for (std::size_t a = start_[cell]; a < start_[cell + 1]; ++a) {
    const Place p = places_[a];
    for (std::size_t b = cell == other ? a + 1 : start_[other]; b < start_[other + 1]; ++b) {
      const Place& q = places_[b];
      double dx = q.x - p.x;
      double dy = q.y - p.y;
      if constexpr (round_corner) {
        const Vec2 apart = nearest_image(Vec2{dx, dy}, box_);
        dx = apart.x;
        dy = apart.y;
      }
      const double r2 = dx * dx + dy * dy;
      if (!(r2 < r_max2)) continue;
      const auto bin = static_cast<std::size_t>(std::sqrt(r2) * bins_per_length);
      if (bin < bins_.bins) add(bin, p, q);
    }
  }
}

template <class Add>
void DistanceCells::visit(std::size_t begin, std::size_t end, const Add& add) const {
  Neighbours around{};
  for (std::size_t row = begin; row < end; ++row) {
    for (std::size_t column = 0; column < x_.cells; ++column) {
      const std::size_t home = row * x_.cells + column;
      const bool at_side = row + 1 == y_.cells || column == 0 || column + 1 == x_.cells;
      const auto visit_with = [&](std::size_t other) {
        at_side ? visit_between<true>(home, other, add) : visit_between<false>(home, other, add);
      };
      visit_with(home);
      const std::size_t n = neighbours(row, column, around);
      for (std::size_t k = 0; k < n; ++k) visit_with(around[k]);
    }
  }
}

// The same whoever runs the blocks, as whole numbers add up to the same in any order.
PairCounts count_pairs(const Disks& disks, const Domain& box, const DistanceBins& bins,
                       const BlockRunner& run = run_in_order);

// The places from which pairs are counted: the box without a margin along sides that are not periodic, where they are
// at the time of the box, so that the whole circle of radius r_max lies where centres can be. Area; length^2.
double area_of_centres(const Domain& box, const DistanceBins& bins);

}  // namespace carom
