// Where the sides that move are, for messages.
#pragma once

#include <fmt/format.h>

#include <string>

#include "core/scene/scene_names.hpp"

namespace carom {

// Its coordinate, x or y, at time t.
inline double side_coordinate(const Domain& box, Side side, double t) {
  const double inset = box.motions[static_cast<std::size_t>(side)].at(t).inset;
  if (side == Side::left || side == Side::bottom) return inset;
  return (side == Side::right ? box.width : box.height) - inset;
}

// "the right side is at x = 3.2", and so on for each of them.
inline std::string moving_sides_text(const Domain& box, double t) {
  std::string text;
  for (const Side side : all_sides) {
    if (!box.moves(side)) continue;
    const bool vertical = side == Side::left || side == Side::right;
    text +=
        fmt::format("{}the {} side is at {} = {:g}", text.empty() ? "" : ", ",
                    side_names[static_cast<std::size_t>(side)], vertical ? 'x' : 'y', side_coordinate(box, side, t));
  }
  return text;
}

}  // namespace carom
