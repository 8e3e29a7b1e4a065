// The surroundings of the box in a picture: title, colour bar or list of groups, kinds of side, time and number of
// disks.
#pragma once

#include "io/movie/frame.hpp"

namespace carom {

inline constexpr double left_margin = 28.0, right_margin = 132.0, top_margin = 78.0, bottom_margin = 48.0;  // units
inline constexpr double side_width = 4.0;  // of a wall's line; units
inline constexpr Colour obstacle_colour{150.0, 150.0, 150.0};

// Draws what is the same in all frames.
void draw_legends(_cairo* context, const FrameStyle& style, const FrameLayout& layout);

// Draws the sides of the box, outside of it, so that a disk at the wall is entirely visible. Sides that move are drawn
// at their places at this time.
void draw_sides(_cairo* context, const FrameStyle& style, const FrameLayout& layout, double time);

// Draws inner walls in the same way.
void draw_inner_walls(_cairo* context, const FrameStyle& style, const FrameLayout& layout, double time);

void draw_stamps(_cairo* context, const FrameStyle& style, const FrameLayout& layout, std::size_t disks, double time);

}  // namespace carom
