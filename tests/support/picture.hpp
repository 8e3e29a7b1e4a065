// Boxes and disks to be drawn, and tests of pixels of a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "io/movie/frame.hpp"

namespace carom::test {

inline Domain square_box(double side) {
  Domain box;
  box.width = box.height = side;
  return box;
}

inline Disks one_disk(double x, double y, double vx, double radius) {
  Disks d;
  append(d, {x, y, vx, 0.0, radius, 1.0, 0});
  return d;
}

inline std::uint32_t pixel(const FramePainter& painter, int column, int row) {
  std::uint32_t value = 0;
  std::memcpy(&value, painter.pixels() + 4 * (static_cast<std::ptrdiff_t>(row) * painter.width() + column), 4);
  return value & 0xffffffU;
}

inline std::uint32_t packed(const Colour& c) {
  return (static_cast<std::uint32_t>(std::lround(c.red)) << 16) |
         (static_cast<std::uint32_t>(std::lround(c.green)) << 8) | static_cast<std::uint32_t>(std::lround(c.blue));
}

// Columns left to right - 1, rows top to bottom - 1.
struct PixelRange {
  int left = 0, right = 0, top = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

// The smallest range that contains all pixels of this range that are not white; empty if there are none.
inline PixelRange ink_in(const FramePainter& painter, const PixelRange& range) {
  PixelRange ink{range.right, range.left, range.bottom, range.top};
  for (int row = range.top; row < range.bottom; ++row) {
    for (int column = range.left; column < range.right; ++column) {
      if (pixel(painter, column, row) == 0xffffffU) continue;
      ink = {std::min(ink.left, column), std::max(ink.right, column + 1), std::min(ink.top, row),
             std::max(ink.bottom, row + 1)};
    }
  }
  return ink.right > ink.left ? ink : PixelRange{};
}

// A hash of the ink in a range: equal for the same word in the same font at any place. 0 without ink.
inline std::uint64_t shape_in(const FramePainter& painter, const PixelRange& range) {
  const PixelRange ink = ink_in(painter, range);
  if (ink.width() == 0) return 0;
  std::uint64_t shape = 14695981039346656037U;  // FNV-1a
  const auto add = [&](std::uint64_t value) { shape = (shape ^ value) * 1099511628211U; };
  add(static_cast<std::uint64_t>(ink.width()));
  for (int row = ink.top; row < ink.bottom; ++row) {
    for (int column = ink.left; column < ink.right; ++column) add(pixel(painter, column, row));
  }
  return shape;
}

}  // namespace carom::test
