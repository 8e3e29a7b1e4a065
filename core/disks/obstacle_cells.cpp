#include "core/disks/obstacle_cells.hpp"

namespace carom {

std::string name_of(const Obstacle& o) {
  return (o.is_segment() ? "wall walls." : "fixed disk ") + std::to_string(o.id);
}

namespace {

// Cells along a side whose cells are to be about so long.
std::int64_t cells_for(double length, double cell, std::size_t obstacles) {
  const double most = 4.0 * static_cast<double>(obstacles);
  return static_cast<std::int64_t>(std::clamp(std::floor(length / cell), 1.0, most));
}

}  // namespace

ObstacleCells::ObstacleCells(const std::vector<Obstacle>& obstacles, const Domain& box) : obstacles_(obstacles) {
  const double wanted = std::sqrt(box.width * box.height / (2.0 * static_cast<double>(obstacles.size())));
  const auto axis = [&](double length, bool periodic) {
    const std::int64_t cells = cells_for(length, wanted, obstacles.size());
    return Axis{length, periodic, cells, static_cast<double>(cells) / length};
  };
  x_ = axis(box.width, box.periodic_x());
  y_ = axis(box.height, box.periodic_y());
  for (const Obstacle& o : obstacles_) {
    const auto span = [&](const Axis& along, double c, double d) {
      return along.span(c + std::min(d, 0.0) - o.radius, c + std::max(d, 0.0) + o.radius);
    };
    reach_.push_back({span(x_, o.x, o.dx), span(y_, o.y, o.dy)});
    has_sinks_ = has_sinks_ || o.kind == ObstacleKind::sink;
  }
  // Counted first, then entered.
  const auto for_each_entry = [&](auto&& enter) {
    for (std::uint32_t k = 0; k < obstacles_.size(); ++k) {
      for (std::int64_t row = reach_[k].rows.first; row <= reach_[k].rows.last; ++row) {
        for (std::int64_t column = reach_[k].columns.first; column <= reach_[k].columns.last; ++column) {
          const std::int64_t py = y_.periods(row);
          const std::int64_t px = x_.periods(column);
          const auto cell = static_cast<std::size_t>((row - py * y_.cells) * x_.cells + (column - px * x_.cells));
          enter(cell, Entry{k, static_cast<std::int32_t>(px), static_cast<std::int32_t>(py)});
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

bool ObstacleCells::dissipates() const {
  return std::any_of(obstacles_.begin(), obstacles_.end(),
                     [](const Obstacle& o) { return o.restitution < 1.0 && o.kind != ObstacleKind::sink; });
}

std::unique_ptr<const ObstacleCells> place_obstacles(const std::vector<Obstacle>& obstacles, Domain& box) {
  box.obstacles = nullptr;
  if (obstacles.empty()) return nullptr;
  auto cells = std::make_unique<const ObstacleCells>(obstacles, box);
  box.obstacles = cells.get();
  return cells;
}

}  // namespace carom
