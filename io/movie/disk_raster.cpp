#include "io/movie/disk_raster.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

constexpr double smallest_round = 0.7;  // pixels; below, shape cannot be seen

// One component, `share` of the way from the pixel's value to the new one.
std::uint32_t blend(std::uint32_t pixel, unsigned shift, double value, double share) {
  const double old = static_cast<double>((pixel >> shift) & 0xffU);
  return static_cast<std::uint32_t>(std::lround(old + share * (value - old))) << shift;
}

void tint(const PixelArea& area, int column, int row, const Colour& colour, double share) {
  if (column < area.left || column >= area.right || row < area.top || row >= area.bottom) return;
  std::uint32_t& pixel = area.pixels[static_cast<std::ptrdiff_t>(row) * area.stride + column];
  pixel =
      blend(pixel, 16, colour.red, share) | blend(pixel, 8, colour.green, share) | blend(pixel, 0, colour.blue, share);
}

// The disk's area, shared among the four pixels around its centre.
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

}  // namespace

void fill_disk(const PixelArea& area, double x, double y, double r, const Colour& colour) {
  if (x + r < area.left - 1 || x - r > area.right + 1 || y + r < area.top - 1 || y - r > area.bottom + 1) return;
  if (r < smallest_round) return tint_point(area, x, y, r, colour);
  const double edge = rim_shade(r);
  const int left = std::max(area.left, static_cast<int>(std::floor(x - r - 0.5)));
  const int right = std::min(area.right, static_cast<int>(std::ceil(x + r + 0.5)));
  const int top = std::max(area.top, static_cast<int>(std::floor(y - r - 0.5)));
  const int bottom = std::min(area.bottom, static_cast<int>(std::ceil(y + r + 0.5)));
  for (int row = top; row < bottom; ++row) {
    const double dy = row + 0.5 - y;
    for (int column = left; column < right; ++column) {
      const double dx = column + 0.5 - x;
      const double distance = std::sqrt(dx * dx + dy * dy);
      const double share = std::min(r + 0.5 - distance, 1.0);
      if (share <= 0.0) continue;
      const double inside = std::clamp(r - rim_width + 0.5 - distance, 0.0, 1.0);
      const double shade = edge + (1.0 - edge) * inside;
      tint(area, column, row, {colour.red * shade, colour.green * shade, colour.blue * shade}, share);
    }
  }
}

}  // namespace carom
