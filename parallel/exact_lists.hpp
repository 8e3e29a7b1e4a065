// Who may meet whom: for every disk the list of disks near it, good as long as both stay near the places where they
// were listed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/disks.hpp"
#include "core/exact_path.hpp"
#include "parallel/cell_grid.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/executor.hpp"
#include "parallel/nearby_runs.hpp"

namespace carom {

// Calls visit(first, last) for runs of cells [first, last) of a level, neighbours in memory, that together are those
// within reach (length) of (x, y).
template <class Visit>
void for_each_keys_near(const GridLevel& level, const Domain& box, double x, double y, double reach, Visit&& visit) {
  const Span rows = span_around(y, reach, box.height, level.rows_per_length, level.rows, box.periodic_y());
  const Span columns = span_around(x, reach, box.width, level.columns_per_length, level.columns, box.periodic_x());
  for (std::uint32_t k = 0, row = rows.first; k < rows.count; ++k, row = row + 1 < level.rows ? row + 1 : 0) {
    for (std::uint32_t left = columns.count, column = columns.first; left > 0;) {
      // Up to the end of the band or of the row.
      const std::uint32_t band = std::min(level.columns - column, level.columns_left_in_band(column));
      const std::uint32_t run = std::min(left, band);
      const std::uint32_t first = level.key_at(row, column);
      visit(first, first + run);
      left -= run;
      column = column + run < level.columns ? column + run : 0;
    }
  }
}

// Each disk has a place, where it was when listed, and may move by `roam` from it. Disks i and j are in each other's
// lists whenever their places are within r_i + r_j + 2 roam (nearest image); so while both are within roam of their
// places, disks that are not listed together cannot touch. A disk that is about to roam too far is listed anew.
class ExactLists {
  static constexpr std::uint32_t none = 0xffffffffU;

 public:
  // Sorts the disks into cells (their storage order changes) and lists all of them where they are.
  void build(Disks& disks, const Domain& box, const Executor& executor);

  bool empty() const { return rows_.empty(); }
  // Disks listed anew since the last build.
  std::size_t listed_anew() const { return moved_.size(); }
  // Length that a disk may go from its place; infinite when everybody is in everybody's list.
  double roam() const { return roam_; }

  // No path faster than this (v^2) leads to any other image of a neighbour than the nearest one within a window of this
  // length, nor a quarter round the box. Negative: any may.
  double safe_speed2(double length, double g) const;

  // Calls see(near, count) for the neighbours of disk i, some at a time: their storage indices, at most chunk of them.
  static constexpr std::uint32_t chunk = 20;
  template <class See>
  void see_neighbours(std::uint32_t i, See&& see) const {
    const Row& row = rows_[i];
    std::uint32_t near[chunk];
    for (std::uint32_t k = 0; k < chunk; ++k) near[k] = i + static_cast<std::uint32_t>(std::int32_t{row.offset[k]});
    see(static_cast<const std::uint32_t*>(near), std::uint32_t{row.count});
    for (std::uint32_t w = row.more; w != none;) {
      const WideRow& wide = wide_[i >> block_shift_][w];
      see(static_cast<const std::uint32_t*>(wide.near), wide.count);
      w = wide.next;
    }
  }
  // Calls see(j) for each neighbour j of disk i.
  template <class See>
  void for_each_neighbour(std::uint32_t i, See&& see) const {
    see_neighbours(i, [&](const std::uint32_t* near, std::uint32_t count) {
      for (std::uint32_t k = 0; k < count; ++k) see(near[k]);
    });
  }

  // Asks the memory for the list of disk i.
  void prefetch(std::uint32_t i) const { __builtin_prefetch(&rows_[i]); }

  // Bits (1 << side) of the walls and sinks that the disk can touch without roaming too far.
  unsigned sides_near(std::uint32_t i) const { return rows_[i].sides; }

  // A time up to which the disk, now (at time `from`) on this path, stays within roam of its place; `from` itself when
  // it does not. Looks no further ahead than `until`, or as far as gravity bends the path little.
  double exit_time(std::uint32_t i, const PathSegment& path, double from, double until, double g) const;

  // Does the disk, within roam of its place at time `from`, stay so until `until`? May say no where exit_time would say
  // yes, never the other way round; much faster.
  bool stays(std::uint32_t i, const PathSegment& path, double from, double until, double g) const;

  // Where each disk was stored before the last build; empty if the storage order did not change.
  std::span<const std::uint32_t> order() const { return {cells_.order.data(), everybody() ? 0 : cells_.order.size()}; }

  // Lists these disks anew at these places, inside the box. Not to be called while others read.
  void list_anew(std::span<const std::uint32_t> which, std::span<const Vec2> places, const Disks& disks,
                 const Executor& executor);

  // Calls see(j) for all disks whose places are within `distance` of a place for some disk of radius 0, their radii
  // added; for a few others too, and for some twice.
  template <class See>
  void visit_near(double x, double y, double distance, See&& see) const {
    const auto run = [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t j = first; j < last; ++j) see(j);
    };
    visit_runs_near(x, y, distance, run, see);
  }

 private:
  // The same, most of them as runs of disks [first, last).
  template <class Run, class See>
  void visit_runs_near(double x, double y, double distance, Run&& run, See&& see) const {
    if (everybody()) {
      run(0, static_cast<std::uint32_t>(rows_.size()));
      return;
    }
    for (const GridLevel& level : grid_.levels) {
      const double reach = (distance + level.largest_radius) * (1.0 + 1e-9);
      for_each_keys_near(level, box_, x, y, reach, [&](std::uint32_t first, std::uint32_t last) {
        run(cells_.start[first], cells_.start[last]);
        if (moved_.empty()) return;
        for (std::uint32_t key = first; key < last; ++key) {
          for (std::uint32_t m = head_[key]; m != none; m = moved_[m].next) see(moved_[m].disk);
        }
      });
    }
  }

  // A disk's place and list in one cache line. Neighbours are stored nearby, mostly; offsets to them fit in 16 bits.
  struct alignas(64) Row {
    double x = 0.0, y = 0.0;    // place; length
    std::uint32_t more = none;  // number of a wide row in its block
    std::uint8_t count = 0;
    std::uint8_t sides = 0;
    std::int16_t offset[chunk] = {};
  };
  static_assert(sizeof(Row) == 64);
  // Those that did not fit in the row.
  struct alignas(64) WideRow {
    std::uint32_t near[14];
    std::uint32_t count;
    std::uint32_t next;
  };
  struct Moved {
    std::uint32_t disk, next;
  };

  bool everybody() const { return roam_ == HUGE_VAL; }
  void choose_roam(const Disks& disks);
  void list_block(const Disks& disks, std::size_t begin, std::size_t end);
  template <class PlaceOf>
  void find_neighbours(const Disks& disks, std::uint32_t i, PlaceOf&& place_of,
                       std::vector<std::uint32_t>& found) const;
  std::uint32_t key_of_place(const Disks& disks, std::uint32_t i) const;
  bool lists(std::uint32_t i, std::uint32_t j) const;
  unsigned find_sides(const Disks& disks, std::uint32_t i) const;
  void insert(std::uint32_t i, std::uint32_t j);
  void replace_list(std::uint32_t i, std::span<const std::uint32_t> found);

  Domain box_;
  CellGrid grid_;
  SortedCells cells_;
  double roam_ = 0.0;
  double largest_radius_ = 0.0;
  unsigned block_shift_ = 0;  // 2^block_shift_ disks share a vector for their wide rows
  std::vector<Row> rows_;
  std::vector<std::vector<WideRow>> wide_;  // one a block
  // Disks listed anew, chained by cell: head_[key] is the last one that came to that cell.
  std::vector<std::uint32_t> head_;
  std::vector<Moved> moved_;
  std::vector<std::vector<std::uint32_t>> found_;  // scratch
};

}  // namespace carom
