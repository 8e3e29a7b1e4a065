// Who may meet whom: for every disk the list of disks near it, good as long as both stay near the places where they
// were listed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/physics/exact_path.hpp"
#include "parallel/cells/cell_grid.hpp"
#include "parallel/cells/counting_sort.hpp"
#include "parallel/cells/nearby_runs.hpp"
#include "parallel/exact/nearby_kernel.hpp"
#include "parallel/threads/executor.hpp"

namespace carom {

// Calls visit(first, last) for runs of cells [first, last) of a level, neighbours in memory, that together are those
// within reach (length) of (x, y).
template <class Visit>
void for_each_keys_near(const GridLevel& level, const Domain& box, double x, double y, double reach, Visit&& visit) {
  const Span rows = span_around(y, reach, box.height, level.rows_per_length, level.rows, box.periodic_y());
  const Span columns = span_around(x, reach, box.width, level.columns_per_length, level.columns, box.periodic_x());
  for (std::uint32_t left = columns.count, column = columns.first; left > 0;) {
    // Up to the end of the band or of the row.
    const std::uint32_t band = std::min(level.columns - column, level.columns_left_in_band(column));
    const std::uint32_t run = std::min(left, band);
    const std::uint32_t column_key = level.first_key + level.key_of_column(column);
    for (std::uint32_t k = 0, row = rows.first; k < rows.count; ++k, row = row + 1 < level.rows ? row + 1 : 0) {
      const std::uint32_t first = column_key + level.key_of_row(row);
      visit(first, first + run);
    }
    left -= run;
    column = column + run < level.columns ? column + run : 0;
  }
}

// Part of the cells and of the disks, both neighbours in memory: what one thread may read and write.
struct ListsPart {
  std::uint32_t first_key = 0, last_key = 0xffffffffU;    // cells [first, last)
  std::uint32_t first_disk = 0, last_disk = 0xffffffffU;  // disks stored in [first, last)
  bool nobody_moved = false;                              // all are in the cells that they were sorted into
  bool holds(std::uint32_t disk) const { return disk >= first_disk && disk < last_disk; }
};

// Scratch of the search for neighbours, and whom it found.
struct FoundDisks {
  std::vector<std::uint32_t> room;
  std::size_t count = 0;
  std::span<const std::uint32_t> disks() const { return {room.data(), count}; }
  void grow(std::size_t disks);
};

// Each disk has a place, where it was when listed, and may move by `roam` from it. Disks i and j are in each other's
// lists whenever their places are within r_i + r_j + 2 roam (nearest image); so while both are within roam of their
// places, disks that are not listed together cannot touch. A disk that has come a certain share of the way is listed
// anew.
class ExactLists {
  static constexpr std::uint32_t none = 0xffffffffU;

 public:
  // Sorts the disks into cells (their storage order changes) and lists all of them where they are. disks_per_tile: of
  // the grid; 0: it has no tiles. share: of the roam, after which a disk is to be listed anew.
  void build(Disks& disks, const Domain& box, std::size_t disks_per_tile, double share, const Executor& executor);

  // Length that a disk may go from its place, and after which it is to be listed anew; infinite when everybody is in
  // everybody's list.
  double roam() const { return roam_; }
  double range() const { return range_; }
  // Of disk i; inside the box, but for rounding.
  Vec2 place_of(std::uint32_t i) const { return place_at(spot_[i]); }

  // Runs of disks in storage that are neighbours in space; one if the grid has no tiles.
  std::uint32_t tiles() const { return grid_.tiles; }
  std::uint32_t first_disk_of(std::uint32_t tile) const {
    return grid_.tile_keys == 0 ? (tile == 0 ? 0 : static_cast<std::uint32_t>(rows_.size()))
                                : cells_.start[std::size_t{tile} * grid_.tile_keys];
  }
  ListsPart part_of_tiles(std::uint32_t first, std::uint32_t last) const {
    return {first * grid_.tile_keys, last * grid_.tile_keys, first_disk_of(first), first_disk_of(last), false};
  }
  // Of disk i, if the grid has tiles.
  std::uint32_t tile_of(std::uint32_t i) const { return rows_[i].home; }

  // No path faster than this (v^2) leads to any other image of a neighbour than the nearest one within a window of this
  // length, nor a quarter round the box. Negative: any may.
  double safe_speed2(double length, double g) const;

  // Calls near(offset, count) and, where those are not all, far(offset, count): the neighbours of disk i are disks i +
  // offset[k], at most chunk at a time; what follows up to the next multiple of four is 0.
  static constexpr std::uint32_t chunk = 28;
  template <class Near, class Far>
  void see_offsets(std::uint32_t i, Near&& near, Far&& far) const {
    const Row& row = rows_[i];
    near(static_cast<const std::int16_t*>(row.offset), std::uint32_t{row.count});
    for (std::uint32_t w = row.more; w != none;) {
      const WideRow& wide = wide_[row.home][w];
      far(static_cast<const std::int32_t*>(wide.offset), wide.count);
      w = wide.next;
    }
  }
  // Calls see(j) for each neighbour j of disk i.
  template <class See>
  void for_each_neighbour(std::uint32_t i, See&& see) const {
    const auto some = [&](const auto* offset, std::uint32_t count) {
      for (std::uint32_t k = 0; k < count; ++k) see(i + static_cast<std::uint32_t>(std::int32_t{offset[k]}));
    };
    see_offsets(i, some, some);
  }

  // Asks the memory for the list of disk i, or of disks [first, last).
  void prefetch(std::uint32_t i) const {
    __builtin_prefetch(&rows_[i]);
    __builtin_prefetch(&spot_[i]);
  }
  void prefetch(std::uint32_t first, std::uint32_t last) const {
    for (std::uint32_t i = first; i < last; ++i) __builtin_prefetch(&rows_[i]);
    for (std::uint32_t i = first; i < last; i += 64 / sizeof(Spot)) __builtin_prefetch(&spot_[i]);
  }

  // Bits (1 << side) of the walls and sinks that the disk can touch without roaming too far.
  unsigned sides_near(std::uint32_t i) const { return rows_[i].sides; }

  // A time up to which the disk, now (at time `from`) on this path, stays within range of its place; `from` itself when
  // it does not. Looks no further ahead than `until`, or as far as gravity bends the path little.
  double exit_time(std::uint32_t i, const PathSegment& path, double from, double until, double g) const;

  // Does the disk, within range of its place at time `from`, stay so until `until`? May say no where exit_time would
  // say yes, never the other way round; much faster.
  bool stays(std::uint32_t i, const PathSegment& path, double from, double until, double g) const;

  // Gives back memory that only building needs, where that is much.
  void release_scratch();

  // Brings a column of the disks that were there at the last build, in the storage order before it, into the present
  // one.
  void sort_along(std::vector<double>& column, const Executor& executor);

  // Lists disk i anew at this place, inside the box. Reads and writes nothing outside the part; if that will not do, it
  // changes nothing and returns false. found: scratch.
  bool list_anew(std::uint32_t i, Vec2 place, const Disks& disks, const ListsPart& part, FoundDisks& found);

  // Calls see(j) for all disks whose places are within `distance` of a place for some disk of radius 0, their radii
  // added; for a few others too, and for some twice.
  template <class See>
  void visit_near(double x, double y, double distance, See&& see) const {
    const auto run = [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t j = first; j < last; ++j) see(j);
    };
    visit_runs_near({x, y}, distance, ListsPart{}, run, see);
  }

 private:
  // The same, most of them as runs of disks [first, last). False, perhaps too early, if it would leave the part.
  template <class Run, class See>
  bool visit_runs_near(Vec2 place, double distance, const ListsPart& part, Run&& run, See&& see) const {
    if (everybody()) {
      run(0, static_cast<std::uint32_t>(rows_.size()));
      return true;
    }
    bool inside = true;
    for (const GridLevel& level : grid_.levels) {
      // Cells know where disks were, spots where they are taken to be.
      const double reach = (distance + level.largest_radius) * (1.0 + 1e-9) + std::max(unit_x_, unit_y_);
      for_each_keys_near(level, box_, place.x, place.y, reach, [&](std::uint32_t first, std::uint32_t last) {
        inside = inside && first >= part.first_key && last <= part.last_key;
        if (!inside) return;
        run(cells_.start[first], cells_.start[last]);
        if (part.nobody_moved) return;
        for (std::uint32_t key = first; key < last; ++key) {
          for (std::uint32_t m = head_[key]; m != none; m = next_[m]) see(m);
        }
      });
    }
    return inside;
  }

  // A disk's list in one cache line. Neighbours are stored nearby, mostly; offsets to them fit in 16 bits. Offsets
  // beyond count are 0.
  struct alignas(64) Row {
    std::uint32_t more = none;  // number of a wide row of its home
    std::uint8_t count = 0;
    std::uint8_t sides = 0;
    std::uint16_t home = 0;  // tile or block
    std::int16_t offset[chunk] = {};
  };
  static_assert(sizeof(Row) == 64);
  // Those that did not fit in the row.
  static constexpr std::uint32_t wide_chunk = 12;
  struct alignas(64) WideRow {
    std::int32_t offset[wide_chunk] = {};
    std::uint32_t count = 0;
    std::uint32_t next = none;
  };

  bool everybody() const { return roam_ == HUGE_VAL; }
  void choose_roam(const Disks& disks, double share);
  void sort(Disks& disks, std::size_t disks_per_tile, const Executor& executor);
  void list_block(const Disks& disks, std::size_t home, std::size_t begin, std::size_t end);
  Spot spot_at(double x, double y) const;
  Vec2 place_at(Spot spot) const { return {spot.x * unit_x_, spot.y * unit_y_}; }
  bool find_neighbours(const Disks& disks, std::uint32_t i, Spot spot, const ListsPart& part, FoundDisks& found) const;
  std::uint32_t key_of_spot(const Disks& disks, std::uint32_t i, Spot spot) const;
  bool lists(std::uint32_t i, std::uint32_t j) const;
  unsigned find_sides(const Disks& disks, std::uint32_t i) const;
  void insert(std::uint32_t i, std::uint32_t j);
  void insert_wide(Row& row, std::int32_t offset);
  void fill(std::uint32_t i, std::span<const std::uint32_t> found);
  void unchain(std::uint32_t i, std::uint32_t key);

  Domain box_;
  CellGrid grid_;
  SortedCells cells_;
  double roam_ = 0.0;
  double range_ = 0.0;
  double largest_radius_ = 0.0;
  double unit_x_ = 0.0, unit_y_ = 0.0;  // of a Spot; length
  std::vector<Row> rows_;
  std::vector<Spot> spot_;                  // everybody's place
  std::vector<std::vector<WideRow>> wide_;  // of each home
  // Disks listed anew, chained by the cell of their places: head_[key] is the last one that came to that cell.
  std::vector<std::uint32_t> head_;
  std::vector<std::uint32_t> next_;  // of each disk; unchained: still in the cell that it was sorted into
  NearbyKernel nearby_ = choose_nearby_kernel();
};

}  // namespace carom
