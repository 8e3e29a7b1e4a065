#include "io/movie/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

namespace {

// In a Maxwell distribution in two dimensions 99.8 % lies below this many root mean squares.
constexpr double reach = 2.5;

// If all disks have the same value, the scale is that value; the ends of any other scale are multiples of a round step,
// about a quarter of its length.
ValueRange rounded(const ValueRange& range) {
  if (!(range.high > range.low)) return range;
  const double step = round_up((range.high - range.low) / 4.0);
  return {std::floor(range.low / step * (1.0 + 1e-12)) * step, std::ceil(range.high / step * (1.0 - 1e-12)) * step};
}

void widen(ValueRange& range, bool any, double low, double high) {
  range = any ? ValueRange{std::min(range.low, low), std::max(range.high, high)} : ValueRange{low, high};
}

// Summed in order of ids: the same bits in any storage order.
double speed_square_of(const DisksInPieces& disks) {
  const auto n = static_cast<double>(disks.size());
  double mean = 0.0, greatest = 0.0;
  disks.visit([&](const Disks& d) {
    for (const std::size_t i : by_id(d)) {
      const double v2 = d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i];
      mean += v2 / n;
      greatest = std::max(greatest, v2);
    }
  });
  return std::min(greatest, reach * reach * mean);
}

}  // namespace

double round_up(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

void SeenValues::add_radius(double low, double high) {
  widen(radius, any, low, high);
}

void SeenValues::add_mass(double low, double high) {
  widen(mass, any, low, high);
}

void SeenValues::add(const DisksInPieces& disks, const std::vector<DiskId>& group) {
  if (disks.size() == 0) return;
  speed_square = std::max(speed_square, speed_square_of(disks));
  disks.visit([&](const Disks& d) {
    if (d.empty()) return;
    const auto ends = [&](auto value) {
      ValueRange range{value(0), value(0)};
      for (std::size_t i = 1; i < d.size(); ++i) widen(range, true, value(i), value(i));
      return range;
    };
    const ValueRange radii = ends([&](std::size_t i) { return d.radius_of(i); });
    const ValueRange masses = ends([&](std::size_t i) { return d.mass_of(i); });
    add_radius(radii.low, radii.high);
    add_mass(masses.low, masses.high);
    last_id = std::max(last_id, *std::max_element(d.id.begin(), d.id.end()));
    any = true;
  });
  groups = std::max(groups, group.empty() ? 1 : *std::max_element(group.begin(), group.end()) + 1);
}

ValueRange colour_range(const PictureLook& look, const SeenValues& seen) {
  if (look.range) return {(*look.range)[0], (*look.range)[1]};
  switch (look.colour) {
    case ColourBy::radius:
      return rounded(seen.radius);
    case ColourBy::mass:
      return rounded(seen.mass);
    case ColourBy::id:
      return rounded({0.0, static_cast<double>(seen.last_id)});
    case ColourBy::speed:
    case ColourBy::group:
      break;
  }
  return {0.0, round_up(std::sqrt(seen.speed_square))};
}

Colour group_colour(DiskId group) {
  // Blue, orange, green, vermilion, purple, sky blue, yellow, grey.
  constexpr std::array<Colour, 8> colours{{{0, 114, 178},
                                           {230, 159, 0},
                                           {0, 158, 115},
                                           {213, 94, 0},
                                           {204, 121, 167},
                                           {86, 180, 233},
                                           {240, 228, 66},
                                           {153, 153, 153}}};
  return colours[group % colours.size()];
}

}  // namespace carom
