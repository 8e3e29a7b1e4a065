// The obstacles of a run in cells, so that a disk is tested only against those near it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/types.hpp"
#include "core/disks/cell_axis.hpp"
#include "core/disks/clearance.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle.hpp"
#include "core/disks/wall_motion.hpp"

namespace carom {

// A grid of about two cells for each obstacle, or for each of `least`. Each cell lists the obstacles whose bounding
// rectangles reach into it.
class ObstacleGrid {
 public:
  struct Extent {
    std::uint32_t obstacle;
    Vec2 low, high;  // length; may lie beyond periodic sides
  };
  ObstacleGrid() = default;
  ObstacleGrid(const std::vector<Extent>& extents, const Domain& box, std::size_t least = 1);

  // The shorter side of a cell; length.
  double cell() const { return std::min(1.0 / x_.cells_per_length, 1.0 / y_.cells_per_length); }

  // Calls found(k, shift) once for every obstacle k, and every image of it across periodic sides, that may reach into
  // the rectangle; the image is displaced by shift. The rectangle may lie beyond periodic sides by a few periods.
  template <class Found>
  void visit(Vec2 low, Vec2 high, Found&& found) const {
    const CellAxis::Span rows = y_.span(low.y, high.y);
    const CellAxis::Span columns = x_.span(low.x, high.x);
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      const std::int64_t py = y_.periods(row);
      const std::int64_t row_in_box = row - py * y_.cells;
      for (std::int64_t column = columns.first; column <= columns.last; ++column) {
        const std::int64_t px = x_.periods(column);
        const auto cell = static_cast<std::size_t>(row_in_box * x_.cells + (column - px * x_.cells));
        for (std::uint32_t e = start_[cell]; e < start_[cell + 1]; ++e) {
          const Entry& entry = entries_[e];
          const Reach& reach = reach_[entry.extent];
          const std::int64_t kx = px - reach.period_x - entry.period_x;
          const std::int64_t ky = py - reach.period_y - entry.period_y;
          // Only in the first of the cells that the image and the rectangle share.
          if (column != std::max(columns.first, reach.columns.first + kx * x_.cells)) continue;
          if (row != std::max(rows.first, reach.rows.first + ky * y_.cells)) continue;
          found(entry.obstacle, Vec2{static_cast<double>(kx) * x_.length, static_cast<double>(ky) * y_.length});
        }
      }
    }
  }

 private:
  struct Entry {
    std::uint32_t obstacle, extent;
    // The period in which the obstacle itself, not an image, reaches into the cell, counted from that of its first
    // cell.
    std::int32_t period_x, period_y;
  };
  struct Reach {
    CellAxis::Span columns, rows;
    std::int64_t period_x, period_y;  // of the first cell; large if a moving wall has gone round the box many times
  };

  CellAxis x_, y_;
  std::vector<Reach> reach_;          // of each extent
  std::vector<std::uint32_t> start_;  // of each cell in entries_, row by row; one more than cells
  std::vector<Entry> entries_;
};

// The cells of obstacles at rest are made once. Those of moving walls are made anew for each step or window, from the
// area that the walls sweep over in it: so a wall is found wherever it can be, and its cells depend on the time alone.
// For walls that move alike, one Clearance is made once, as if at rest, and displaced with them.
class ObstacleCells {
 public:
  // motions: by the number of the [[walls]] table.
  ObstacleCells(const std::vector<Obstacle>& obstacles, std::vector<WallMotion> motions, const Domain& box);

  const Obstacle& operator[](std::size_t k) const { return obstacles_[k]; }
  std::size_t size() const { return obstacles_.size(); }
  // The shorter side of a cell; length.
  double cell() const { return moving_.empty() ? at_rest_.cell() : std::min(at_rest_.cell(), swept_.cell()); }
  // Does any of them take energy from disks?
  bool dissipates() const;
  // Does any of them move?
  bool move() const { return !moving_.empty(); }
  // Does any of them take disks away?
  bool has_sinks() const { return has_sinks_; }

  // Precondition: o moves.
  const WallMotion& motion_of(const Obstacle& o) const { return motions_[o.id]; }
  // Until the next call, moving walls are found at all times in [from, to]. If they move further than the box is long,
  // as in long steps without disks, only in the last part of that time.
  void follow(double from, double to);

  // As ObstacleGrid::visit. For a moving obstacle, shift is counted from its place in unwrapped coordinates.
  template <class Found>
  void visit(Vec2 low, Vec2 high, Found&& found) const {
    at_rest_.visit(low, high, found);
    if (!moving_.empty()) [[unlikely]]
      swept_.visit(low, high, found);
  }
  // As Clearance::is_clear.
  bool is_clear(Vec2 low, Vec2 high) const {
    return std::all_of(around_.begin(), around_.end(),
                       [&](const Around& a) { return a.clearance.is_clear(low, high); });
  }
  // All obstacles are at least this far from the place; length. Negative where nothing is known.
  double clearance(Vec2 place) const {
    double least = HUGE_VAL;
    for (const Around& a : around_) least = std::min(least, a.clearance.at(place));
    return least;
  }
  // The number of maps that clearance() reads: one for the obstacles at rest, others for moving ones.
  std::size_t clearances() const { return around_.size(); }
  Clearance::Cells clearance_cells(std::size_t k) const { return around_[k].clearance.cells(); }
  // Walls that move in more than most_motions ways share one map, which is made anew for each step or window.
  static constexpr std::size_t most_motions = 4;
  static constexpr std::size_t most_clearances = 1 + most_motions;

 private:
  // The map of obstacles that all have this motion, or are all at rest.
  struct Around {
    WallMotion motion;
    Clearance clearance;
  };
  void find_clearances();

  std::vector<Obstacle> obstacles_;
  std::vector<WallMotion> motions_;
  std::vector<std::uint32_t> moving_;  // obstacles that move
  Domain box_;                         // only its size and its periodic sides are used
  bool has_sinks_ = false;
  ObstacleGrid at_rest_, swept_;
  std::vector<Around>
      around_;  // if moves_in_many_ways_, the last one is that of the areas that moving walls sweep over
  bool moves_in_many_ways_ = false;
};

// Makes the cells of a run's obstacles at the time of the box, and sets box.obstacles to them; null if there are none.
// motions: by the number of the [[walls]] table; without them all obstacles rest at their places of time 0.
std::unique_ptr<ObstacleCells> place_obstacles(const std::vector<Obstacle>& obstacles, Domain& box,
                                               std::vector<WallMotion> motions = {});

// A moving obstacle at its place at time t, wrapped into a periodic box, as an obstacle at rest.
inline Obstacle at_time(Obstacle o, const std::vector<WallMotion>& motions, double t, const Domain& box) {
  if (!o.moves) return o;
  const Vec2 shift = motions[o.id].at({t, t}).shift;
  o.x += shift.x;
  o.y += shift.y;
  if (box.periodic_x()) o.x -= std::floor(o.x / box.width) * box.width;
  if (box.periodic_y()) o.y -= std::floor(o.y / box.height) * box.height;
  o.moves = false;
  return o;
}

// Sets moving sides and inner walls to their places at the end of a step.
inline void step_walls(Domain& box, ObstacleCells* obstacles, double from, double to) {
  box.step_walls(from, to);
  if (obstacles != nullptr) obstacles->follow(from, to);
}

}  // namespace carom
