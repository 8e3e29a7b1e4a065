#include "core/start/circle_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/start/lattice.hpp"

namespace carom {

namespace {

// One row: sites at (column + shift) spacing for columns first to last.
struct Row {
  double shift = 0.0;
  double first = 0.0, last = -1.0;
};

double row_spacing(const CircleLattice& lattice, double spacing) {
  return lattice.hexagonal ? triangle_height * spacing : spacing;
}

double last_row(const CircleLattice& lattice, double spacing) {
  return std::floor(lattice.reach * lattice_rounding / row_spacing(lattice, spacing));
}

Row row_at(const CircleLattice& lattice, double spacing, double row) {
  const double y = row * row_spacing(lattice, spacing);
  const double reach = lattice.reach * lattice_rounding;
  const double half = std::sqrt(std::max(0.0, reach * reach - y * y)) / spacing;
  const bool odd = lattice.hexagonal && 2.0 * std::floor(0.5 * row) != row;
  const double shift = odd ? 0.5 : 0.0;
  return {shift, -std::floor(half + shift), std::floor(half - shift)};
}

// The number of sites. Counting stops soon after `enough`: a large circle may have very many rows.
double sites(const CircleLattice& lattice, double spacing, double enough) {
  const double last = last_row(lattice, spacing);
  double all = 0.0;
  for (double row = -last; row <= last && all < enough; row += 1.0) {
    const Row r = row_at(lattice, spacing, row);
    all += std::max(0.0, r.last - r.first + 1.0);
  }
  return all;
}

// A spacing at which only the site at the centre lies in the circle.
double spacing_of_one(const CircleLattice& lattice) {
  return 2.0 * lattice.reach + 2.0 * lattice.diameter;
}

// The widest spacing with room for `count` sites, by bisection: the number of sites falls, nearly monotonically, as the
// spacing grows.
double widest_spacing(const CircleLattice& lattice, double count) {
  double fits = lattice.diameter;
  double too_wide = spacing_of_one(lattice);
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (fits + too_wide);
    (sites(lattice, middle, count) >= count ? fits : too_wide) = middle;
  }
  return fits;
}

struct Site {
  double row, column, distance2;
  Vec2 place;
};

}  // namespace

Count circle_capacity(const CircleLattice& lattice) {
  constexpr double most = 4.3e9;  // more than there are ids
  return static_cast<Count>(std::min(sites(lattice, lattice.diameter, most), most));
}

std::vector<Vec2> circle_sites(const CircleLattice& lattice, Count count) {
  const auto wanted = static_cast<double>(count);
  if (sites(lattice, lattice.diameter, wanted) < wanted) return {};
  const double spacing = count == 1 ? spacing_of_one(lattice) : widest_spacing(lattice, wanted);
  std::vector<Site> all;
  const double last = last_row(lattice, spacing);
  for (double row = -last; row <= last; row += 1.0) {
    const Row r = row_at(lattice, spacing, row);
    for (double column = r.first; column <= r.last; column += 1.0) {
      const Vec2 p{(column + r.shift) * spacing, row * row_spacing(lattice, spacing)};
      all.push_back({row, column, p.x * p.x + p.y * p.y, p});
    }
  }
  const auto nearer = [](const Site& a, const Site& b) {
    return std::tie(a.distance2, a.row, a.column) < std::tie(b.distance2, b.row, b.column);
  };
  std::sort(all.begin(), all.end(), nearer);
  all.resize(count);
  std::sort(all.begin(), all.end(),
            [](const Site& a, const Site& b) { return std::tie(a.row, a.column) < std::tie(b.row, b.column); });
  std::vector<Vec2> places;
  for (const Site& site : all) places.push_back(site.place);
  return places;
}

}  // namespace carom
