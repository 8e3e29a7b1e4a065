#include "core/start/lattice.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

Count whole(double ratio) {
  return ratio < 1.0 ? 0 : static_cast<Count>(std::min(ratio, 4.3e9));
}

Count divide_up(Count a, Count b) {
  return (a + b - 1) / b;
}

// The spacings of a hexagonal lattice for a given number of columns.
struct Spacing {
  double x = 0.0;
  double first_x = 0.0;
  double least_y = 0.0;  // rows may not be closer than this
};

Spacing columns_spacing(const Domain& box, Count columns, double diameter) {
  Spacing s;
  const auto n = static_cast<double>(columns);
  if (box.periodic_x()) {
    s.x = box.width / n;
    s.first_x = 0.25 * s.x;
  } else {
    // Half a spacing at either side, and half for the shift of the odd rows; with one column less is enough at the
    // sides.
    s.x = box.width / (n + 0.5);
    s.first_x = 0.5 * s.x;
    if (s.first_x < 0.5 * diameter) {
      s.first_x = 0.5 * diameter;
      s.x = (box.width - diameter) / (n - 0.5);
    }
  }
  // Neighbours in adjacent rows are half a spacing apart in x; every second row has the same x.
  const double rest = diameter * diameter - 0.25 * (s.x * s.x);
  s.least_y = std::max(0.5 * diameter, rest > 0.0 ? std::sqrt(rest) : 0.0);
  return s;
}

bool columns_fit(const Domain& box, Count columns, const Spacing& s, double diameter) {
  return s.x * lattice_rounding >= diameter || (columns == 1 && !box.periodic_x());
}

// The most rows that fit; an even number if the height is periodic, so that the shift closes.
Count most_rows(const Domain& box, const Spacing& s, double diameter) {
  if (box.periodic_y()) return whole(box.height / s.least_y * lattice_rounding) / 2 * 2;
  return whole((box.height - diameter) / s.least_y * lattice_rounding) + 1;
}

Count most_columns(const Domain& box, double diameter) {
  const double ratio = box.width / diameter * lattice_rounding;
  return std::max<Count>(1, whole(box.periodic_x() ? ratio : ratio - 0.5));
}

Lattice hexagonal_of(const Domain& box, Count columns, Count rows, double diameter) {
  const Spacing s = columns_spacing(box, columns, diameter);
  Lattice lattice{columns, rows, s.x, 0.0, s.first_x, 0.0, 0.5 * s.x};
  const auto n = static_cast<double>(rows);
  if (box.periodic_y()) {
    lattice.spacing_y = box.height / n;
    lattice.first_y = 0.5 * lattice.spacing_y;
    return lattice;
  }
  // The distance to the sides is the radius to which the lattice's disks could grow until they touch.
  const double reach = 0.5 / triangle_height;
  lattice.spacing_y = box.height / (n - 1.0 + 2.0 * reach);
  lattice.first_y = reach * lattice.spacing_y;
  if (rows == 1) {
    lattice.first_y = 0.5 * box.height;
  } else if (lattice.first_y < 0.5 * diameter || lattice.spacing_y < s.least_y) {
    lattice.first_y = 0.5 * diameter;
    lattice.spacing_y = (box.height - diameter) / (n - 1.0);
  }
  return lattice;
}

// The ratio or its inverse, whichever is larger.
double distortion(double ratio) {
  return std::max(ratio, 1.0 / ratio);
}

// The least distorted of the lattices with first to last columns; make(columns) returns a lattice or nullopt.
template <class Make>
std::optional<Lattice> least_distorted(Count first, Count last, double ideal_ratio, Make make) {
  std::optional<Lattice> best;
  for (Count columns = first; columns <= last; ++columns) {
    const std::optional<Lattice> lattice = make(columns);
    if (!lattice) continue;
    const double d = distortion(lattice->spacing_y / (lattice->spacing_x * ideal_ratio));
    if (!best || d < distortion(best->spacing_y / (best->spacing_x * ideal_ratio))) best = lattice;
  }
  return best;
}

// Tries numbers of columns within a factor of two of the ideal one first, and all others only if none of those has
// room.
template <class Make>
std::optional<Lattice> search_columns(double ideal, Count last, double ideal_ratio, Make make) {
  const double middle = std::clamp(ideal, 1.0, static_cast<double>(last));
  const auto first_tried = static_cast<Count>(std::max(1.0, 0.5 * middle));
  const auto last_tried = std::min(last, static_cast<Count>(2.0 * middle) + 2);
  const std::optional<Lattice> near = least_distorted(first_tried, last_tried, ideal_ratio, make);
  return near ? near : least_distorted(1, last, ideal_ratio, make);
}

}  // namespace

std::optional<Lattice> square_lattice(const Domain& box, Count count, double diameter) {
  const Count widest = std::max<Count>(1, whole(box.width / diameter * lattice_rounding));
  const Count highest = std::max<Count>(1, whole(box.height / diameter * lattice_rounding));
  const auto make = [&](Count columns) -> std::optional<Lattice> {
    const Count rows = divide_up(count, columns);
    if (rows > highest) return std::nullopt;
    const double a = box.width / static_cast<double>(columns);
    const double b = box.height / static_cast<double>(rows);
    return Lattice{columns, rows, a, b, 0.5 * a, 0.5 * b, 0.0};
  };
  const double ideal = std::sqrt(static_cast<double>(count) * (box.width / box.height));
  return search_columns(ideal, std::min(widest, count), 1.0, make);
}

std::optional<Lattice> hexagonal_lattice(const Domain& box, Count count, double diameter) {
  const auto make = [&](Count columns) -> std::optional<Lattice> {
    const Spacing s = columns_spacing(box, columns, diameter);
    if (!columns_fit(box, columns, s, diameter)) return std::nullopt;
    Count rows = divide_up(count, columns);
    if (box.periodic_y()) rows += rows % 2;
    if (rows > most_rows(box, s, diameter)) return std::nullopt;
    return hexagonal_of(box, columns, rows, diameter);
  };
  const double ideal = std::sqrt(static_cast<double>(count) * triangle_height * (box.width / box.height));
  return search_columns(ideal, std::min(most_columns(box, diameter), count), triangle_height, make);
}

Count square_capacity(const Domain& box, double diameter) {
  return whole(box.width / diameter * lattice_rounding) * whole(box.height / diameter * lattice_rounding);
}

Count hexagonal_capacity(const Domain& box, double diameter) {
  Count most = 0;
  const Count widest = most_columns(box, diameter);
  for (Count columns = 1; columns <= widest; ++columns) {
    const Spacing s = columns_spacing(box, columns, diameter);
    if (columns_fit(box, columns, s, diameter)) most = std::max(most, columns * most_rows(box, s, diameter));
  }
  return most;
}

Vec2 lattice_site(const Lattice& lattice, Count k, Count count) {
  const Count site = k * (lattice.columns * lattice.rows) / count;
  const Count row = site / lattice.columns;
  const Count column = site % lattice.columns;
  const double x = lattice.first_x + static_cast<double>(column) * lattice.spacing_x;
  return {row % 2 == 1 ? x + lattice.shift : x, lattice.first_y + static_cast<double>(row) * lattice.spacing_y};
}

}  // namespace carom
