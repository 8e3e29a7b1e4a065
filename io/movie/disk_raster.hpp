// Draws filled disks into an image: a million disks take a few milliseconds, with a vector library seconds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "io/movie/colour_map.hpp"

namespace carom {

// A part of an image of 32-bit pixels 0x00rrggbb; pixel (0, 0) is the upper left one. Nothing outside is written.
struct PixelArea {
  std::uint32_t* pixels = nullptr;               // of the whole image
  int stride = 0;                                // pixels from one row to the next
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom are exclusive

  std::uint32_t* row(int k) const { return pixels + static_cast<std::ptrdiff_t>(k) * stride; }
};

inline constexpr double rim_width = 1.0;  // pixels

// The brightness of the rim of a disk of this radius (pixels), as a share of its colour. Large disks have a dark rim;
// small ones have none, since one would see nothing else. It changes continuously, so that no disks of a mixture stand
// out.
inline double rim_shade(double radius) {
  constexpr double smallest_rimmed = 3.0, fully_rimmed = 6.0, darkest = 0.35;
  const double strength = std::clamp((radius - smallest_rimmed) / (fully_rimmed - smallest_rimmed), 0.0, 1.0);
  return 1.0 - strength * (1.0 - darkest);
}

// Fills the disk with centre (x, y) and radius r, in pixels, with smooth edges; large disks get a dark rim, so that
// disks in contact can be told apart. A disk smaller than a pixel tints the pixels around it in proportion to its area.
void fill_disk(const PixelArea& area, double x, double y, double r, const Colour& colour);

}  // namespace carom
