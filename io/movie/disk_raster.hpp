// Filling disks into an image, quickly: a million disks take a few milliseconds where a vector library takes seconds.
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

// The rim of a disk of this radius (pixels), as a share of its own colour: dark around large ones, as a rim on small
// disks would be all one sees; and in between no step, by which some disks of a mixture would stand out.
inline double rim_shade(double radius) {
  constexpr double smallest_rimmed = 3.0, fully_rimmed = 6.0, darkest = 0.35;
  const double strength = std::clamp((radius - smallest_rimmed) / (fully_rimmed - smallest_rimmed), 0.0, 1.0);
  return 1.0 - strength * (1.0 - darkest);
}

// Fills the disk with centre (x, y) and radius r, in pixels, with smooth edges; large ones get a dark rim, so that
// disks in contact stay apart to the eye. A disk smaller than a pixel tints the pixels around it by its area.
void fill_disk(const PixelArea& area, double x, double y, double r, const Colour& colour);

}  // namespace carom
