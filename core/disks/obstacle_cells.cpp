#include "core/disks/obstacle_cells.hpp"

#include <utility>

namespace carom {

std::string name_of(const Obstacle& o) {
  return (o.is_segment() ? "wall walls." : "fixed disk ") + std::to_string(o.id);
}

namespace {

// Number of cells along a side, each about `cell` (length) long.
std::int64_t cells_for(double length, double cell, std::size_t obstacles) {
  const double most = 4.0 * static_cast<double>(obstacles);
  return static_cast<std::int64_t>(std::clamp(std::floor(length / cell), 1.0, most));
}

// There are at least as many cells as for this number of obstacles at rest.
constexpr std::size_t least_at_rest = 128;
// The same for moving obstacles, whose cells are made anew for each step.
constexpr std::size_t least_moving = 16;
// Cells of a Clearance: clearance_cells for each obstacle, so that a cell is an eleventh of their mean spacing long.
// Long walls need more: with clearance_cells_along times the square of their length (both sides) over the box, a ninth
// of the box is within two cells of them. The number in all, one byte each, stays between the last two constants.
constexpr double clearance_cells = 128.0;
constexpr double clearance_cells_along = 256.0;
constexpr double least_clearance_cells = 4096.0;
constexpr double most_clearance_cells = 4194304.0;
// Cells of the Clearance for each wall, where walls move in many ways.
constexpr std::size_t swept_cells = 2;

std::size_t clearance_cells_for(const std::vector<Clearance::Shape>& shapes, const Domain& box) {
  double sides = 0.0;  // length
  for (const Clearance::Shape& s : shapes) sides += 2.0 * std::hypot(s.along.x, s.along.y);
  const double along = clearance_cells_along * (sides / box.width) * (sides / box.height);
  const double wanted = std::max(clearance_cells * static_cast<double>(shapes.size()), along);
  return static_cast<std::size_t>(std::clamp(wanted, least_clearance_cells, most_clearance_cells));
}

}  // namespace

ObstacleGrid::ObstacleGrid(const std::vector<Extent>& extents, const Domain& box, std::size_t least) {
  const std::size_t n = std::max(least, extents.size());
  const double wanted = std::sqrt(box.width * box.height / (2.0 * static_cast<double>(n)));
  const auto axis = [&](double length, bool periodic) {
    const std::int64_t cells = cells_for(length, wanted, n);
    return CellAxis{length, periodic, cells, static_cast<double>(cells) / length};
  };
  x_ = axis(box.width, box.periodic_x());
  y_ = axis(box.height, box.periodic_y());
  for (const Extent& e : extents) {
    const CellAxis::Span columns = x_.span(e.low.x, e.high.x), rows = y_.span(e.low.y, e.high.y);
    reach_.push_back({columns, rows, x_.periods(columns.first), y_.periods(rows.first)});
  }
  // Counting sort: entries of each cell are counted first, then stored.
  const auto for_each_entry = [&](auto&& enter) {
    for (std::uint32_t k = 0; k < extents.size(); ++k) {
      for (std::int64_t row = reach_[k].rows.first; row <= reach_[k].rows.last; ++row) {
        for (std::int64_t column = reach_[k].columns.first; column <= reach_[k].columns.last; ++column) {
          const std::int64_t py = y_.periods(row);
          const std::int64_t px = x_.periods(column);
          const auto cell = static_cast<std::size_t>((row - py * y_.cells) * x_.cells + (column - px * x_.cells));
          enter(cell, Entry{extents[k].obstacle, k, static_cast<std::int32_t>(px - reach_[k].period_x),
                            static_cast<std::int32_t>(py - reach_[k].period_y)});
        }
      }
    }
  };
  start_.assign(static_cast<std::size_t>(x_.cells * y_.cells) + 1, 0);
  for_each_entry([&](std::size_t cell, const Entry&) { ++start_[cell + 1]; });
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  entries_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for_each_entry([&](std::size_t cell, const Entry& entry) { entries_[next[cell]++] = entry; });
}

ObstacleCells::ObstacleCells(const std::vector<Obstacle>& obstacles, std::vector<WallMotion> motions, const Domain& box)
    : obstacles_(obstacles), motions_(std::move(motions)), box_(box) {
  std::vector<ObstacleGrid::Extent> at_rest;
  for (std::uint32_t k = 0; k < obstacles_.size(); ++k) {
    Obstacle& o = obstacles_[k];
    o.moves = o.moves && o.id < motions_.size() && motions_[o.id].moves();
    has_sinks_ = has_sinks_ || o.kind == ObstacleKind::sink;
    if (o.moves) {
      moving_.push_back(k);
      continue;
    }
    at_rest.push_back({k,
                       {o.x + std::min(o.dx, 0.0) - o.radius, o.y + std::min(o.dy, 0.0) - o.radius},
                       {o.x + std::max(o.dx, 0.0) + o.radius, o.y + std::max(o.dy, 0.0) + o.radius}});
  }
  at_rest_ = ObstacleGrid(at_rest, box, at_rest.empty() ? 1 : least_at_rest);
  find_clearances();
  follow(box.clock.from, box.clock.to);
}

void ObstacleCells::find_clearances() {
  std::vector<WallMotion> motions;
  std::vector<std::vector<Clearance::Shape>> shapes;  // of those that move alike
  for (const Obstacle& o : obstacles_) {
    const WallMotion motion = o.moves ? motions_[o.id] : WallMotion{};
    const auto known = std::find(motions.begin(), motions.end(), motion);
    const auto alike = static_cast<std::size_t>(known - motions.begin());
    if (known == motions.end()) {
      motions.push_back(motion);
      shapes.emplace_back();
    }
    shapes[alike].push_back({{o.x, o.y}, {o.dx, o.dy}, o.radius});
  }
  const auto ways = std::count_if(motions.begin(), motions.end(), [](const WallMotion& m) { return m.moves(); });
  moves_in_many_ways_ = static_cast<std::size_t>(ways) > most_motions;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    if (moves_in_many_ways_ && motions[m].moves()) continue;
    around_.push_back({motions[m], Clearance(box_, shapes[m], clearance_cells_for(shapes[m], box_))});
  }
  if (moves_in_many_ways_) around_.emplace_back();
}

void ObstacleCells::follow(double from, double to) {
  if (moving_.empty()) return;
  // A wall moves further than this in a step only while there are no disks.
  const double longest_way = std::min(box_.width, box_.height);
  std::vector<ObstacleGrid::Extent> swept;
  std::vector<Clearance::Extent> extents;
  for (const std::uint32_t k : moving_) {
    const Obstacle& o = obstacles_[k];
    const WallMotion& motion = motions_[o.id];
    const WallMotion::Range range = motion.range(std::max(from, to - longest_way / motion.largest_speed()), to);
    const Vec2 low{o.x + std::min(o.dx, 0.0) + range.low.x, o.y + std::min(o.dy, 0.0) + range.low.y};
    const Vec2 high{o.x + std::max(o.dx, 0.0) + range.high.x, o.y + std::max(o.dy, 0.0) + range.high.y};
    // The place of a wall that has moved by many periods is known less exactly.
    const Vec2 slack{0x1p-48 * (std::abs(low.x) + std::abs(high.x)), 0x1p-48 * (std::abs(low.y) + std::abs(high.y))};
    extents.push_back({{low.x - slack.x, low.y - slack.y}, {high.x + slack.x, high.y + slack.y}});
    swept.push_back({k, extents.back().low, extents.back().high});
  }
  swept_ = ObstacleGrid(swept, box_, least_moving);
  if (moves_in_many_ways_) {
    around_.back().clearance = Clearance(box_, extents, swept_cells * std::max(least_moving, extents.size()));
    return;
  }
  for (Around& a : around_) {
    if (!a.motion.moves()) continue;
    const WallMotion::Range range = a.motion.range(from, to);
    a.clearance.displace(range.low, range.high);
  }
}

bool ObstacleCells::dissipates() const {
  return std::any_of(obstacles_.begin(), obstacles_.end(),
                     [](const Obstacle& o) { return o.restitution < 1.0 && o.kind != ObstacleKind::sink; });
}

std::unique_ptr<ObstacleCells> place_obstacles(const std::vector<Obstacle>& obstacles, Domain& box,
                                               std::vector<WallMotion> motions) {
  box.obstacles = nullptr;
  if (obstacles.empty()) return nullptr;
  auto cells = std::make_unique<ObstacleCells>(obstacles, std::move(motions), box);
  box.obstacles = cells.get();
  return cells;
}

}  // namespace carom
