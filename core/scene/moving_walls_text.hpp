// The places of moving walls, for messages.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "core/scene/scene_names.hpp"

namespace carom {

// The coordinate of a side, x or y, at time t.
inline double side_coordinate(const Domain& box, Side side, double t) {
  const double inset = box.motions[static_cast<std::size_t>(side)].at(t).inset;
  if (side == Side::left || side == Side::bottom) return inset;
  return (side == Side::right ? box.width : box.height) - inset;
}

// "the right side is at x = 3.2, wall walls.0 has moved by (2, 0)" and so on; of many inner walls only the first.
inline std::string moving_walls_text(const Domain& box, double t) {
  constexpr std::size_t most = 4;
  std::string text;
  for (const Side side : all_sides) {
    if (!box.moves(side)) continue;
    const bool vertical = side == Side::left || side == Side::right;
    text +=
        fmt::format("{}the {} side is at {} = {:g}", text.empty() ? "" : ", ",
                    side_names[static_cast<std::size_t>(side)], vertical ? 'x' : 'y', side_coordinate(box, side, t));
  }
  if (!box.inner_walls_move || box.obstacles == nullptr) return text;
  const ObstacleCells& obstacles = *box.obstacles;
  std::vector<DiskId> told;
  for (std::size_t k = 0; k < obstacles.size() && told.size() < most; ++k) {
    const Obstacle& o = obstacles[k];
    if (!o.moves || (!told.empty() && told.back() == o.id)) continue;
    told.push_back(o.id);
    const Vec2 shift = obstacles.motion_of(o).at({t, t}).shift;
    text += fmt::format("{}{} has moved by ({:g}, {:g})", text.empty() ? "" : ", ", name_of(o), shift.x, shift.y);
  }
  return text;
}

}  // namespace carom
