// How many pairs of disks are how far apart: what the pair correlation g(r) is made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/scene/scene.hpp"

namespace carom {

// Distances from 0 to r_max in equal bins: bin k holds k r_max / bins <= r < (k + 1) r_max / bins.
// Precondition: r_max is at most half of each periodic side.
struct DistanceBins {
  double r_max = 0.0;  // length
  std::size_t bins = 0;
  double wall_margin = 0.0;  // see AnalysisPlan
};

// The centres, sorted into cells no smaller than r_max, so that all partners are in the 3 x 3 cells around. A side with
// room for fewer than three cells has one.
class DistanceCells {
 public:
  DistanceCells(const Disks& disks, const Domain& box, const DistanceBins& bins);

  std::size_t rows() const { return rows_; }
  std::size_t centres() const { return centres_; }

  // Adds to counts[k] the ordered pairs (i, j) in bin k whose first disk is a centre, of which the one in the lower
  // cell lies in rows [begin, end). Integers: rows may be counted apart, in any order, and added.
  void count(std::size_t begin, std::size_t end, std::vector<Count>& counts) const;

 private:
  struct Place {
    double x, y;      // length
    unsigned centre;  // 1: its surroundings count
  };
  struct Axis {
    double length = 0.0;
    bool periodic = false;
    std::size_t cells = 1;
  };
  Axis axis(double length, bool periodic, std::size_t disks) const;
  std::size_t neighbours(std::size_t row, std::size_t column, std::array<std::size_t, 4>& cells) const;
  template <bool round_corner>
  void count_between(std::size_t cell, std::size_t other, std::vector<Count>& counts) const;

  DistanceBins bins_;
  Axis x_, y_;
  std::size_t rows_ = 1;
  std::size_t centres_ = 0;
  std::vector<std::uint32_t> start_;  // of each cell in places_, one more than cells
  std::vector<Place> places_;
};

// Pairs of one moment.
struct PairCounts {
  Count centres = 0;          // disks whose surroundings were counted
  std::vector<Count> counts;  // ordered pairs from them, by bin
};

// What counts them: serially, or on all threads with the same result.
using PairCounter = std::function<PairCounts(const Disks&, const Domain&, const DistanceBins&)>;

PairCounts count_pairs(const Disks& disks, const Domain& box, const DistanceBins& bins);

// The places from which pairs are counted: the box without a margin along sides that are not periodic, so that the
// whole circle of radius r_max lies where centres can be. Area; length^2.
double area_of_centres(const Domain& box, const DistanceBins& bins);

}  // namespace carom
