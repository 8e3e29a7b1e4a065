#include "core/load/wall_warnings.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/scene/scene_names.hpp"

namespace carom {

namespace {

// The side along which the segment from a to b lies.
std::optional<Side> side_along(const Domain& box, const Vec2& a, const Vec2& b) {
  if (a.x == b.x && a.x == 0.0) return Side::left;
  if (a.x == b.x && a.x == box.width) return Side::right;
  if (a.y == b.y && a.y == 0.0) return Side::bottom;
  if (a.y == b.y && a.y == box.height) return Side::top;
  return {};
}

bool differs(const InnerWall& wall, const Domain& box, Side side) {
  if (wall.sink || box.side(side) != SideKind::wall || box.moves(side)) return false;
  return wall.motion.moves() || box.is_thermal(side) || wall.restitution != box.restitution(side);
}

// The first side along which the wall lies and from which it differs.
std::optional<Side> side_behind(const InnerWall& wall, const Domain& box) {
  for (std::size_t k = 0; k + 1 < wall.points.size(); ++k) {
    const std::optional<Side> side = side_along(box, wall.points[k], wall.points[k + 1]);
    if (side && differs(wall, box, *side)) return side;
  }
  return {};
}

}  // namespace

std::vector<std::string> wall_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const std::optional<Side> side = side_behind(scene.walls[k], scene.box);
    if (!side) continue;
    warnings.push_back(fmt::format(
        "{}:{}: walls.{}: lies along the {} side, and a disk that comes to both meets {}; put it before the side, by a "
        "thousandth of a radius{}",
        scene.file, scene.walls[k].line, k, side_names[static_cast<std::size_t>(*side)],
        scene.run.method == Method::rollback ? "the side" : "either, as rounding has it",
        scene.run.method == Method::rollback ? ", and take another method" : ""));
  }
  return warnings;
}

}  // namespace carom
