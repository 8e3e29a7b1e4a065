#include "core/disks/clearance.hpp"

#include <cmath>

namespace carom {

namespace {

// Distances are stored in steps, so many of which make up a cell.
constexpr double steps_a_cell = 4.0;
constexpr std::uint8_t most_steps = 255;
// Within so many cells of a shape, the distance of each cell's middle is computed; further off, cells are counted.
constexpr double cells_measured = 4.0;
// Makes bounds a little smaller than computed, since places are rounded.
constexpr double share = 1.0 - 1e-6;

// The distance of a point from a shape's segment.
double distance_from_segment(const Clearance::Shape& shape, Vec2 point) {
  const Vec2 apart{point.x - shape.from.x, point.y - shape.from.y};
  const double length2 = shape.along.x * shape.along.x + shape.along.y * shape.along.y;
  const double forward = apart.x * shape.along.x + apart.y * shape.along.y;
  const double s = length2 > 0.0 ? std::clamp(forward / length2, 0.0, 1.0) : 0.0;
  const double dx = apart.x - s * shape.along.x;
  const double dy = apart.y - s * shape.along.y;
  return std::sqrt(dx * dx + dy * dy);
}

// The part of a shape's segment, in shares of its length, that lies within `reach` of this height; empty if first >
// last.
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
  lay_cells(box, cells);
  std::vector<double> nearest(steps_.size(), HUGE_VAL);
  for (const Shape& shape : shapes) enter_shape(shape, nearest);
  store_bounds(nearest);
}

Clearance::Clearance(const Domain& box, const std::vector<Extent>& extents, std::size_t cells) {
  lay_cells(box, cells);
  std::vector<double> nearest(steps_.size(), HUGE_VAL);
  for (const Extent& extent : extents) enter_extent(extent, nearest);
  store_bounds(nearest);
}

void Clearance::lay_cells(const Domain& box, std::size_t cells) {
  const double most = static_cast<double>(cells);
  const double across = std::clamp(std::sqrt(most * (box.width / box.height)), 1.0, most);
  const auto axis = [](double length, bool periodic, double count) {
    const auto whole = static_cast<std::int64_t>(count);
    return CellAxis{length, periodic, whole, static_cast<double>(whole) / length};
  };
  x_ = axis(box.width, box.periodic_x(), across);
  y_ = axis(box.height, box.periodic_y(), std::clamp(most / across, 1.0, most));
  cell_ = std::min(1.0 / x_.cells_per_length, 1.0 / y_.cells_per_length);
  half_diagonal_ = 0.5 * std::hypot(1.0 / x_.cells_per_length, 1.0 / y_.cells_per_length);
  step_ = share * cell_ / steps_a_cell;
  steps_.assign(static_cast<std::size_t>(x_.cells * y_.cells), most_steps);
}

// Row by row, so that a long segment costs only the cells along it, not all those of its rectangle. A shape that
// reaches beyond a side that is not periodic is entered as its rectangle, which can be clipped.
void Clearance::enter_shape(const Shape& shape, std::vector<double>& nearest) const {
  const Vec2 to{shape.from.x + shape.along.x, shape.from.y + shape.along.y};
  const Extent extent{{std::min(shape.from.x, to.x) - shape.radius, std::min(shape.from.y, to.y) - shape.radius},
                      {std::max(shape.from.x, to.x) + shape.radius, std::max(shape.from.y, to.y) + shape.radius}};
  const auto is_beyond = [](double low, double high, const CellAxis& axis) {
    return !axis.periodic && (low < 0.0 || high > axis.length);
  };
  if (is_beyond(extent.low.x, extent.high.x, x_) || is_beyond(extent.low.y, extent.high.y, y_)) {
    return enter_extent(extent, nearest);
  }
  const double reach = shape.radius + half_diagonal_ + cells_measured * cell_;
  const CellAxis::Span rows = y_.span(std::min(shape.from.y, to.y) - reach, std::max(shape.from.y, to.y) + reach);
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    const double height = (static_cast<double>(row) + 0.5) / y_.cells_per_length;
    const Part part = part_at_height(shape, height, reach);
    if (part.first > part.last) continue;
    const double one = shape.from.x + part.first * shape.along.x;
    const double other = shape.from.x + part.last * shape.along.x;
    enter(
        {{std::min(one, other) - reach, height}, {std::max(one, other) + reach, height}},
        [&](Vec2 middle) { return std::max(distance_from_segment(shape, middle) - shape.radius, 0.0); }, nearest);
  }
}

// Along a periodic axis, a rectangle longer than a period covers all of it. Beyond other sides the rectangle is clipped
// to the box, which brings it no further from any place in the box.
void Clearance::enter_extent(Extent extent, std::vector<double>& nearest) const {
  const auto clip = [](double& low, double& high, const CellAxis& axis) {
    if (axis.periodic) {
      high = std::min(high, low + axis.length);
    } else {
      low = std::clamp(low, 0.0, axis.length);
      high = std::clamp(high, 0.0, axis.length);
    }
  };
  clip(extent.low.x, extent.high.x, x_);
  clip(extent.low.y, extent.high.y, y_);
  const double reach = half_diagonal_ + cells_measured * cell_;
  const auto outside = [](double c, double low, double high) { return std::max({low - c, c - high, 0.0}); };
  enter(
      {{extent.low.x - reach, extent.low.y - reach}, {extent.high.x + reach, extent.high.y + reach}},
      [&](Vec2 middle) {
        const double x = outside(middle.x, extent.low.x, extent.high.x);
        const double y = outside(middle.y, extent.low.y, extent.high.y);
        return std::sqrt(x * x + y * y);
      },
      nearest);
}

// Lowers `nearest` in all cells of the extent. distance(middle): of the shape from the middle of a cell, which may lie
// beyond periodic sides.
template <class Distance>
void Clearance::enter(const Extent& extent, Distance&& distance, std::vector<double>& nearest) const {
  const CellAxis::Span rows = y_.span(extent.low.y, extent.high.y);
  const CellAxis::Span columns = x_.span(extent.low.x, extent.high.x);
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    for (std::int64_t column = columns.first; column <= columns.last; ++column) {
      const Vec2 middle{(static_cast<double>(column) + 0.5) / x_.cells_per_length,
                        (static_cast<double>(row) + 0.5) / y_.cells_per_length};
      double& there = nearest[static_cast<std::size_t>(y_.in_box(row) * x_.cells + x_.in_box(column))];
      there = std::min(there, distance(middle));
    }
  }
}

// For each cell, how many cells away (the larger number along x or y) the nearest cell is into which a shape reaches.
// Spreads from those cells to the eight around each, and so on.
std::vector<std::uint8_t> Clearance::rings_around(const std::vector<double>& nearest) const {
  constexpr std::uint8_t furthest = 255;
  std::vector<std::uint8_t> rings(nearest.size(), furthest);
  std::vector<std::size_t> reached;
  reached.reserve(nearest.size());
  for (std::size_t cell = 0; cell < nearest.size(); ++cell) {
    if (nearest[cell] * share > half_diagonal_) continue;
    rings[cell] = 0;
    reached.push_back(cell);
  }
  const auto columns = static_cast<std::size_t>(x_.cells), rows = static_cast<std::size_t>(y_.cells);
  // The change of index from cell k of an axis to the cell before it (or after it), also across a periodic side; 0 if
  // there is none. apart: the difference between neighbours' indices.
  const auto before = [](std::size_t k, std::size_t cells, bool periodic, std::size_t apart) {
    return k > 0 ? std::size_t{0} - apart : periodic ? (cells - 1) * apart : 0;
  };
  const auto after = [](std::size_t k, std::size_t cells, bool periodic, std::size_t apart) {
    return k + 1 < cells ? apart : periodic ? std::size_t{0} - (cells - 1) * apart : 0;
  };
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::size_t from = reached[next], row = from / columns, column = from - row * columns;
    const std::uint8_t away = rings[from];
    if (away + 1 >= furthest) break;
    const std::size_t down = before(row, rows, y_.periodic, columns), up = after(row, rows, y_.periodic, columns);
    const std::size_t left = before(column, columns, x_.periodic, 1), right = after(column, columns, x_.periodic, 1);
    for (const std::size_t there : {from + down + left, from + down, from + down + right, from + left, from + right,
                                    from + up + left, from + up, from + up + right}) {
      if (rings[there] != furthest) continue;
      rings[there] = static_cast<std::uint8_t>(away + 1);
      reached.push_back(there);
    }
  }
  return rings;
}

// Stores the larger of two bounds: from the distance of the cell's middle, if that was computed, and from the number of
// cells between it and the nearest one into which a shape reaches.
void Clearance::store_bounds(const std::vector<double>& nearest) {
  const std::vector<std::uint8_t> rings = rings_around(nearest);
  for (std::size_t c = 0; c < steps_.size(); ++c) {
    const double measured = std::min(nearest[c] - half_diagonal_, cells_measured * cell_);
    const double counted = (static_cast<double>(rings[c]) - 1.0) * cell_;
    const double steps = std::floor(std::max({measured, counted, 0.0}) * (steps_a_cell / cell_));
    steps_[c] = static_cast<std::uint8_t>(std::min(steps, static_cast<double>(most_steps)));
  }
}

void Clearance::displace(Vec2 low, Vec2 high) {
  const auto in_box = [](double shift, const CellAxis& axis) {
    return axis.periodic ? shift - std::floor(shift / axis.length) * axis.length : shift;
  };
  shift_ = {in_box(0.5 * (low.x + high.x), x_), in_box(0.5 * (low.y + high.y), y_)};
  // A displacement of many periods is known less exactly.
  const double way = std::max({std::abs(low.x), std::abs(high.x), std::abs(low.y), std::abs(high.y)});
  const double rounding = 0x1p-46 * (way + x_.length + y_.length);
  blur_ = 0.5 * std::hypot(high.x - low.x, high.y - low.y) + rounding;
}

Clearance::Cells Clearance::cells() const {
  Cells cells;
  cells.steps = steps_.data();
  cells.columns = static_cast<double>(x_.cells);
  cells.rows = static_cast<double>(y_.cells);
  cells.columns_per_length = x_.cells_per_length;
  cells.rows_per_length = y_.cells_per_length;
  cells.size = {x_.length, y_.length};
  cells.period = {x_.periodic ? x_.length : 0.0, y_.periodic ? y_.length : 0.0};
  cells.shift = shift_;
  cells.step = step_;
  cells.blur = blur_;
  return cells;
}

}  // namespace carom
