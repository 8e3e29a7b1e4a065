#include "core/disks/clearance.hpp"

#include <cmath>

namespace carom {

namespace {

// The distance of a point from a shape's segment, squared.
double distance2(const Clearance::Shape& shape, Vec2 point) {
  const Vec2 apart{point.x - shape.from.x, point.y - shape.from.y};
  const double length2 = shape.along.x * shape.along.x + shape.along.y * shape.along.y;
  const double share = apart.x * shape.along.x + apart.y * shape.along.y;
  const double s = length2 > 0.0 ? std::clamp(share / length2, 0.0, 1.0) : 0.0;
  const double dx = apart.x - s * shape.along.x;
  const double dy = apart.y - s * shape.along.y;
  return dx * dx + dy * dy;
}

// The shares of a shape's segment between which its height is within `reach` of this one; none where first > last.
struct Part {
  double first, last;
};
Part part_at_height(const Clearance::Shape& shape, double height, double reach) {
  if (shape.along.y == 0.0) return std::abs(shape.from.y - height) <= reach ? Part{0.0, 1.0} : Part{1.0, 0.0};
  const double one = (height - reach - shape.from.y) / shape.along.y;
  const double other = (height + reach - shape.from.y) / shape.along.y;
  return {std::max(std::min(one, other), 0.0), std::min(std::max(one, other), 1.0)};
}

}  // namespace

Clearance::Clearance(const Domain& box, const std::vector<Shape>& shapes, std::size_t cells) {
  begin(box, cells);
  for (const Shape& shape : shapes) mark_shape(shape);
  spread();
}

Clearance::Clearance(const Domain& box, const std::vector<Extent>& extents, std::size_t cells) {
  begin(box, cells);
  for (const Extent& extent : extents) mark_all(extent);
  spread();
}

void Clearance::begin(const Domain& box, std::size_t cells) {
  const double most = static_cast<double>(cells);
  const double across = std::clamp(std::sqrt(most * (box.width / box.height)), 1.0, most);
  const auto axis = [](double length, bool periodic, double count) {
    const auto whole = static_cast<std::int64_t>(count);
    return CellAxis{length, periodic, whole, static_cast<double>(whole) / length};
  };
  x_ = axis(box.width, box.periodic_x(), across);
  y_ = axis(box.height, box.periodic_y(), std::clamp(most / across, 1.0, most));
  cell_ = std::min(1.0 / x_.cells_per_length, 1.0 / y_.cells_per_length);
  away_.assign(static_cast<std::size_t>(x_.cells * y_.cells), furthest);
}

// What is as long as a period is everywhere along it.
void Clearance::mark_all(Extent extent) {
  const auto end = [](double low, double high, const CellAxis& axis) {
    return axis.periodic ? std::min(high, low + axis.length) : high;
  };
  extent.high = {end(extent.low.x, extent.high.x, x_), end(extent.low.y, extent.high.y, y_)};
  mark(extent, [](Vec2) { return true; });
}

// A cell may be touched if its middle is within half its diagonal. What reaches beyond a side that is not periodic is
// in the outermost cells there.
void Clearance::mark_shape(const Shape& shape) {
  const double half_diagonal = 0.5 * std::hypot(1.0 / x_.cells_per_length, 1.0 / y_.cells_per_length);
  const double reach = (shape.radius + half_diagonal) * (1.0 + 1e-6);
  const Vec2 to{shape.from.x + shape.along.x, shape.from.y + shape.along.y};
  const Extent extent{{std::min(shape.from.x, to.x) - shape.radius, std::min(shape.from.y, to.y) - shape.radius},
                      {std::max(shape.from.x, to.x) + shape.radius, std::max(shape.from.y, to.y) + shape.radius}};
  const auto is_beyond = [](double low, double high, const CellAxis& axis) {
    return !axis.periodic && (low < 0.0 || high > axis.length);
  };
  if (is_beyond(extent.low.x, extent.high.x, x_) || is_beyond(extent.low.y, extent.high.y, y_)) return mark_all(extent);
  // Row by row, so that a long segment costs the cells along it, not those of its rectangle.
  const CellAxis::Span rows = y_.span(extent.low.y, extent.high.y);
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    const double height = (static_cast<double>(row) + 0.5) / y_.cells_per_length;
    const Part part = part_at_height(shape, height, reach);
    if (part.first > part.last) continue;
    const double one = shape.from.x + part.first * shape.along.x;
    const double other = shape.from.x + part.last * shape.along.x;
    mark({{std::min(one, other) - shape.radius, height}, {std::max(one, other) + shape.radius, height}},
         [&](Vec2 middle) { return distance2(shape, middle) <= reach * reach; });
  }
}

// occupied(middle): does what is there reach into the cell of this middle, which may lie beyond periodic sides?
template <class Occupied>
void Clearance::mark(const Extent& extent, Occupied&& occupied) {
  const CellAxis::Span rows = y_.span(extent.low.y, extent.high.y);
  const CellAxis::Span columns = x_.span(extent.low.x, extent.high.x);
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    for (std::int64_t column = columns.first; column <= columns.last; ++column) {
      const Vec2 middle{(static_cast<double>(column) + 0.5) / x_.cells_per_length,
                        (static_cast<double>(row) + 0.5) / y_.cells_per_length};
      if (occupied(middle)) away_[static_cast<std::size_t>(y_.in_box(row) * x_.cells + x_.in_box(column))] = 0;
    }
  }
}

// From the cells that are occupied to the eight around each, and so on.
void Clearance::spread() {
  struct Cell {
    std::int64_t column, row;
  };
  std::vector<Cell> reached;
  for (std::int64_t row = 0; row < y_.cells; ++row) {
    for (std::int64_t column = 0; column < x_.cells; ++column) {
      if (away_[static_cast<std::size_t>(row * x_.cells + column)] == 0) reached.push_back({column, row});
    }
  }
  // The cell before and after, across a periodic side; itself where there is none.
  const auto next_to = [](std::int64_t k, std::int64_t step, const CellAxis& axis) {
    const std::int64_t to = k + step;
    if (to >= 0 && to < axis.cells) return to;
    return axis.periodic ? axis.in_box(to) : k;
  };
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const Cell from = reached[next];
    const std::uint8_t away = away_[static_cast<std::size_t>(from.row * x_.cells + from.column)];
    if (away + 1 >= furthest) return;
    for (const std::int64_t row : {next_to(from.row, -1, y_), from.row, next_to(from.row, 1, y_)}) {
      for (const std::int64_t column : {next_to(from.column, -1, x_), from.column, next_to(from.column, 1, x_)}) {
        std::uint8_t& there = away_[static_cast<std::size_t>(row * x_.cells + column)];
        if (there != furthest) continue;
        there = static_cast<std::uint8_t>(away + 1);
        reached.push_back({column, row});
      }
    }
  }
}

}  // namespace carom
