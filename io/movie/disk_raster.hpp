// Filling disks into an image, quickly: a million disks take a few milliseconds where a vector library takes seconds.
#pragma once

#include <cstdint>

#include "io/movie/colour_map.hpp"

namespace carom {

// A part of an image of 32-bit pixels 0x00rrggbb; pixel (0, 0) is the upper left one. Nothing outside is written.
struct PixelArea {
  std::uint32_t* pixels = nullptr;               // of the whole image
  int stride = 0;                                // pixels from one row to the next
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom are exclusive
};

inline constexpr double smallest_rimmed = 3.0;  // pixels; a rim on smaller disks would be all one sees
inline constexpr double rim_width = 1.0;        // pixels
inline constexpr double rim_shade = 0.35;       // of the disk's own colour

// Fills the disk with centre (x, y) and radius r, in pixels, with smooth edges; large ones get a dark rim, so that
// disks in contact stay apart to the eye. A disk smaller than a pixel tints the pixels around it by its area.
void fill_disk(const PixelArea& area, double x, double y, double r, const Colour& colour);

}  // namespace carom
