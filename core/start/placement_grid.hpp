// Finds overlaps while an initial state is built: the disks already placed, in cells, with one grid for each class of
// sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"

namespace carom {

// Disks whose radii differ by less than a factor of two share a grid, so that one huge disk among a million small ones
// does not make every cell huge. About 28 bytes for each disk.
class PlacementGrid {
 public:
  // For the disks of box; radii are known, positions are read from disks when a disk is inserted. disks outlives the
  // grid, and holds at most 2^32 - 2 entries.
  PlacementGrid(const Domain& box, const Disks& disks);

  // The same if radii are known only when disks are inserted. expected: approximate numbers of disks in each class;
  // there must be none of other classes.
  PlacementGrid(const Domain& box, const Disks& disks, double largest_radius, const std::vector<std::size_t>& expected);

  // k, for radii in (largest / 2^(k+1), largest / 2^k].
  static std::size_t class_of(double radius, double largest);

  // Adds disk i at its position in disks.
  void insert(std::size_t i);

  // A disk in the grid that overlaps a disk of this radius at (x, y), if any. slack: overlaps within the rounding of
  // the input do not count. Without slack, a disk that touches an inner wall (box.obstacles) overlaps too, and the
  // result is no_disk.
  std::optional<std::size_t> overlapping(double x, double y, double radius, bool slack) const;

  static constexpr std::size_t no_disk = static_cast<std::size_t>(-1);

  // A disk of the grid relative to a point: the nearest image of its centre, and the sum of the radii.
  struct Near {
    double dx, dy, contact;
  };

  // All disks that a disk of this radius overlaps somewhere within `spread` of (x, y).
  void find_near(double x, double y, double radius, double spread, std::vector<Near>& found) const;

  // Prefetch the memory that overlapping(x, y, radius) will read: first the cells, later the disks in them.
  void prefetch_cells(double x, double y) const;
  void prefetch_disks(double x, double y) const;

  // Calls use(i) for every disk in the grid.
  template <class Use>
  void for_each(Use use) const {
    for (const Level& level : levels_) {
      for (std::uint32_t first : level.head) {
        for (std::uint32_t i = first; i != empty_cell; i = next_[i]) use(i);
      }
    }
  }

 private:
  static constexpr std::uint32_t empty_cell = 0xffffffffU;

  struct Level {
    double largest_radius = 0.0;
    std::size_t disks = 0;
    std::size_t columns = 1, rows = 1;
    double per_x = 0.0, per_y = 0.0;  // cells per length
    std::vector<std::uint32_t> head;  // first disk of each cell, row by row; empty_cell if there is none
  };

  void size_cells(Level& level) const;
  Near seen_from(std::size_t i, double x, double y, double radius) const;
  bool overlaps(std::size_t i, double x, double y, double radius, bool slack) const;
  // Calls use(i) for disks in the cells within reach of (x, y) until it returns true; returns whether it did.
  template <class Use>
  bool any_around(const Level& level, double x, double y, double reach, Use use) const;

  const Domain& box_;
  const Disks& disks_;
  double largest_radius_ = 0.0;
  std::vector<Level> levels_;        // by class
  std::vector<Vec2> placed_;         // by index in disks: copies of positions, x and y on the same cache line
  std::vector<std::uint32_t> next_;  // by index in disks: the next disk in the same cell
};

}  // namespace carom
