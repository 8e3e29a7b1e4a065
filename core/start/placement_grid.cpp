#include "core/start/placement_grid.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/huge_pages.hpp"
#include "core/disks/cell_index.hpp"
#include "core/disks/place_slack.hpp"
#include "core/physics/obstacle_contact.hpp"

namespace carom {

namespace {

// The last class of sizes holds all smaller disks, too: radii more than 2^40 apart.
constexpr int last_class = 40;

// The cells along one axis within reach of a coordinate. On a periodic axis the range may start below 0 or end beyond
// the last cell.
struct CellRange {
  std::ptrdiff_t first = 0;
  std::ptrdiff_t count = 0;
};

CellRange cells_around(double coordinate, double reach, double per_length, std::size_t cells, bool periodic) {
  // A margin, in cells, for the rounding of the products.
  constexpr double margin = 1e-6;
  const double low = std::floor((coordinate - reach) * per_length - margin);
  const double high = std::floor((coordinate + reach) * per_length + margin);
  const auto last = static_cast<double>(cells - 1);
  if (periodic) {
    if (high - low >= last) return {0, static_cast<std::ptrdiff_t>(cells)};
    return {static_cast<std::ptrdiff_t>(low), static_cast<std::ptrdiff_t>(high - low) + 1};
  }
  const auto first = static_cast<std::ptrdiff_t>(std::clamp(low, 0.0, last));
  return {first, static_cast<std::ptrdiff_t>(std::clamp(high, 0.0, last)) - first + 1};
}

std::size_t wrap_cell(std::ptrdiff_t cell, std::size_t cells) {
  const auto n = static_cast<std::ptrdiff_t>(cells);
  return static_cast<std::size_t>(cell < 0 ? cell + n : (cell >= n ? cell - n : cell));
}

}  // namespace

std::size_t PlacementGrid::class_of(double radius, double largest) {
  return static_cast<std::size_t>(std::min(last_class, std::ilogb(largest / radius)));
}

PlacementGrid::PlacementGrid(const Domain& box, const Disks& disks)
    : box_(box), disks_(disks), largest_radius_(carom::largest_radius(disks)) {
  resize_in_huge_pages(placed_, disks.size());
  resize_in_huge_pages(next_, disks.size(), empty_cell);
  if (disks.radius.empty()) {
    levels_.resize(1);
    levels_[0].disks = disks.size();
    levels_[0].largest_radius = largest_radius_;
  }
  for (const double radius : disks.radius) {
    const std::size_t k = class_of(radius, largest_radius_);
    if (k >= levels_.size()) levels_.resize(k + 1);
    ++levels_[k].disks;
    levels_[k].largest_radius = std::max(levels_[k].largest_radius, radius);
  }
  for (Level& level : levels_) size_cells(level);
}

PlacementGrid::PlacementGrid(const Domain& box, const Disks& disks, double largest_radius,
                             const std::vector<std::size_t>& expected)
    : box_(box), disks_(disks), largest_radius_(largest_radius), levels_(expected.size()) {
  resize_in_huge_pages(placed_, disks.size());
  resize_in_huge_pages(next_, disks.size(), empty_cell);
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    levels_[k].disks = expected[k];
    levels_[k].largest_radius = std::ldexp(largest_radius, -static_cast<int>(k));
    size_cells(levels_[k]);
  }
}

// Cells are a diameter wide, but there are not many more of them than disks.
void PlacementGrid::size_cells(Level& level) const {
  if (level.disks == 0) return;
  const double width = box_.width;
  const double height = box_.height;
  const std::size_t most = 2 * level.disks + 16;
  const double edge =
      std::max(2.0 * level.largest_radius, width * std::sqrt(height / width / static_cast<double>(most)));
  level.columns = static_cast<std::size_t>(std::clamp(width / edge, 1.0, static_cast<double>(most)));
  const std::size_t most_rows = most / level.columns;
  level.rows = static_cast<std::size_t>(std::clamp(height / edge, 1.0, static_cast<double>(most_rows)));
  level.per_x = static_cast<double>(level.columns) / width;
  level.per_y = static_cast<double>(level.rows) / height;
  resize_in_huge_pages(level.head, level.columns * level.rows, empty_cell);
}

void PlacementGrid::insert(std::size_t i) {
  Level& level = levels_[disks_.radius.empty() ? 0 : class_of(disks_.radius[i], largest_radius_)];
  const std::size_t column = cell_index(disks_.x[i] * level.per_x, level.columns);
  const std::size_t row = cell_index(disks_.y[i] * level.per_y, level.rows);
  std::uint32_t& head = level.head[row * level.columns + column];
  placed_[i] = {disks_.x[i], disks_.y[i]};
  next_[i] = head;
  head = static_cast<std::uint32_t>(i);
}

// The cell itself and those below and above; neighbours in a row mostly share their cache line.
void PlacementGrid::prefetch_cells(double x, double y) const {
  for (const Level& level : levels_) {
    if (level.disks == 0) continue;
    const std::size_t cell =
        cell_index(y * level.per_y, level.rows) * level.columns + cell_index(x * level.per_x, level.columns);
    const std::uint32_t* const head = level.head.data() + cell;
    __builtin_prefetch(head);
    if (cell >= level.columns) __builtin_prefetch(head - level.columns);
    if (cell + level.columns < level.head.size()) __builtin_prefetch(head + level.columns);
  }
}

void PlacementGrid::prefetch_disks(double x, double y) const {
  for (const Level& level : levels_) {
    if (level.disks == 0) continue;
    const std::size_t centre =
        cell_index(y * level.per_y, level.rows) * level.columns + cell_index(x * level.per_x, level.columns);
    if (centre < level.columns + 1 || centre + level.columns + 1 >= level.head.size()) continue;
    for (std::size_t row = 0; row < 3; ++row) {
      const std::size_t first = centre + row * level.columns - level.columns - 1;
      for (std::size_t cell = first; cell < first + 3; ++cell) {
        const std::uint32_t i = level.head[cell];
        if (i == empty_cell) continue;
        __builtin_prefetch(&placed_[i]);
        __builtin_prefetch(&next_[i]);
      }
    }
  }
}

PlacementGrid::Near PlacementGrid::seen_from(std::size_t i, double x, double y, double radius) const {
  const Vec2 apart = nearest_image({placed_[i].x - x, placed_[i].y - y}, box_);
  return {apart.x, apart.y, radius + disks_.radius_of(i)};
}

bool PlacementGrid::overlaps(std::size_t i, double x, double y, double radius, bool slack) const {
  const auto [dx, dy, contact] = seen_from(i, x, y, radius);
  const double distance_squared = dx * dx + dy * dy;
  if (!(distance_squared < contact * contact)) return false;
  return !slack || contact - std::sqrt(distance_squared) > place_slack(box_, contact);
}

template <class Use>
bool PlacementGrid::any_around(const Level& level, double x, double y, double reach, Use use) const {
  const CellRange across = cells_around(x, reach, level.per_x, level.columns, box_.periodic_x());
  const CellRange up = cells_around(y, reach, level.per_y, level.rows, box_.periodic_y());
  for (std::ptrdiff_t r = 0; r < up.count; ++r) {
    const std::size_t row = wrap_cell(up.first + r, level.rows);
    for (std::ptrdiff_t c = 0; c < across.count; ++c) {
      const std::size_t column = wrap_cell(across.first + c, level.columns);
      for (std::uint32_t i = level.head[row * level.columns + column]; i != empty_cell; i = next_[i]) {
        if (use(i)) return true;
      }
    }
  }
  return false;
}

std::optional<std::size_t> PlacementGrid::overlapping(double x, double y, double radius, bool slack) const {
  if (!slack && touches_obstacle(box_, x, y, radius)) return no_disk;
  std::size_t found = 0;
  for (const Level& level : levels_) {
    if (level.disks == 0) continue;
    const bool any = any_around(level, x, y, radius + level.largest_radius, [&](std::uint32_t i) {
      found = i;
      return overlaps(i, x, y, radius, slack);
    });
    if (any) return found;
  }
  return std::nullopt;
}

void PlacementGrid::find_near(double x, double y, double radius, double spread, std::vector<Near>& found) const {
  found.clear();
  for (const Level& level : levels_) {
    if (level.disks == 0) continue;
    any_around(level, x, y, radius + level.largest_radius + spread, [&](std::uint32_t i) {
      const Near disk = seen_from(i, x, y, radius);
      const double reach = disk.contact + spread;
      if (disk.dx * disk.dx + disk.dy * disk.dy < reach * reach) found.push_back(disk);
      return false;
    });
  }
}

}  // namespace carom
