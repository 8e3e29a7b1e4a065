#include "io/movie/disk_raster.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr double smallest_round = 0.7;  // pixels; the shape of a smaller disk is invisible

// One component, mixed from the pixel's value and `share` of the new one.
std::uint32_t blend(std::uint32_t pixel, unsigned shift, double value, double share) {
  const double old = static_cast<double>((pixel >> shift) & 0xffU);
  // No component is negative, so truncation rounds; a rounding function would be a call for each.
  const double mixed = old + share * (value - old) + 0.5;
  return static_cast<std::uint32_t>(mixed) << shift;
}

std::uint32_t blend(std::uint32_t pixel, const Colour& colour, double share) {
  return blend(pixel, 16, colour.red, share) | blend(pixel, 8, colour.green, share) |
         blend(pixel, 0, colour.blue, share);
}

void tint(const PixelArea& area, int column, int row, const Colour& colour, double share) {
  if (column < area.left || column >= area.right || row < area.top || row >= area.bottom) return;
  std::uint32_t& pixel = area.row(row)[column];
  pixel = blend(pixel, colour, share);
}

// Distributes the disk's area over the four pixels around its centre.
void tint_point(const PixelArea& area, double x, double y, double r, const Colour& colour) {
  const double share = std::min(std::numbers::pi * r * r, 1.0);
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double fx = x - 0.5 - left, fy = y - 0.5 - top;
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  tint(area, column, row, colour, share * (1.0 - fx) * (1.0 - fy));
  tint(area, column + 1, row, colour, share * fx * (1.0 - fy));
  tint(area, column, row + 1, colour, share * (1.0 - fx) * fy);
  tint(area, column + 1, row + 1, colour, share * fx * fy);
}

// Columns first to end - 1.
struct Span {
  int first = 0, end = 0;
};

// The columns of the area whose pixels' centres are within the root of `half2` of x.
Span columns_within(const PixelArea& area, double x, double half2) {
  if (!(half2 > 0.0)) return {};
  const double half = std::sqrt(half2);
  return {std::max(area.left, static_cast<int>(std::ceil(x - half - 0.5))),
          std::min(area.right, static_cast<int>(std::floor(x + half - 0.5)) + 1)};
}

}  // namespace

// Most pixels of a large disk have exactly its colour: only for those near its rim a distance is computed.
void fill_disk(const PixelArea& area, double x, double y, double r, const Colour& colour) {
  if (x + r < area.left - 1 || x - r > area.right + 1 || y + r < area.top - 1 || y - r > area.bottom + 1) return;
  if (r < smallest_round) return tint_point(area, x, y, r, colour);
  const double edge = rim_shade(r);
  const double outer = r + 0.5, inner = std::max(0.0, r - rim_width - 0.5);
  const std::uint32_t plain = blend(0, colour, 1.0);
  const int top = std::max(area.top, static_cast<int>(std::floor(y - r - 0.5)));
  const int bottom = std::min(area.bottom, static_cast<int>(std::ceil(y + r + 0.5)));
  for (int row = top; row < bottom; ++row) {
    const double dy2 = (row + 0.5 - y) * (row + 0.5 - y);
    std::uint32_t* const pixels = area.row(row);
    const auto shade_rim = [&](int first, int end) {
      for (int column = first; column < end; ++column) {
        const double dx = column + 0.5 - x;
        const double distance = std::sqrt(dx * dx + dy2);
        const double share = std::clamp(outer - distance, 0.0, 1.0);
        const double inside = std::clamp(r - rim_width + 0.5 - distance, 0.0, 1.0);
        const double shade = edge + (1.0 - edge) * inside;
        pixels[column] = blend(pixels[column], {colour.red * shade, colour.green * shade, colour.blue * shade}, share);
      }
    };
    const Span all = columns_within(area, x, outer * outer - dy2);
    Span within = columns_within(area, x, inner * inner - dy2);
    if (within.first >= within.end) within = {all.end, all.end};
    shade_rim(all.first, within.first);
    std::fill(pixels + within.first, pixels + within.end, plain);
    shade_rim(within.end, all.end);
  }
}

}  // namespace carom
