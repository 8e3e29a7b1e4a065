#include "core/load/wall_warnings.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/scene/place_in_file.hpp"
#include "core/scene/scene_names.hpp"
#include "core/step/step_start.hpp"

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

// The first side along which a segment of the wall lies and from which the wall differs.
std::optional<Side> side_behind(const InnerWall& wall, const Domain& box) {
  for (std::size_t k = 0; k + 1 < wall.points.size(); ++k) {
    const std::optional<Side> side = side_along(box, wall.points[k], wall.points[k + 1]);
    if (side && differs(wall, box, *side)) return side;
  }
  return {};
}

// Does a segment move along itself while disks lie on it?
bool is_belt(const InnerWall& wall, const Gravity& gravity) {
  for (std::size_t k = 0; k + 1 < wall.points.size(); ++k) {
    const double dx = wall.points[k + 1].x - wall.points[k].x, dy = wall.points[k + 1].y - wall.points[k].y;
    if (wall.motion.along.x * dx + wall.motion.along.y * dy != 0.0 && gravity.against(-dy, dx) != 0.0) return true;
  }
  return false;
}

// Would friction drag resting disks along with the wall, although supports of a pile have no friction?
bool loses_hold(const InnerWall& wall, const Scene& scene) {
  if (wall.sink || !wall.motion.moves() || scene.run.method != Method::pairwise) return false;
  return scene.physics.surfaces.are_rough() && scene.physics.surfaces.walls.acts() && settles(scene) &&
         is_belt(wall, scene.physics.gravity);
}

}  // namespace

std::vector<std::string> wall_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t k, const std::string& what) {
    const std::string place = place_in_file(scene.file, scene.walls[k].line, fmt::format("walls.{}", k));
    warnings.push_back(fmt::format("{}: {}", place, what));
  };
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    if (const std::optional<Side> side = side_behind(scene.walls[k], scene.box)) {
      warn(k, fmt::format("lies along the {} side, and a disk that reaches both collides with {}; place the wall "
                          "inside the box, a thousandth of a radius from the side{}",
                          side_names[static_cast<std::size_t>(*side)],
                          scene.run.method == Method::rollback ? "the side" : "either of them, as rounding decides",
                          scene.run.method == Method::rollback ? ", and use another method" : ""));
    }
    if (loses_hold(scene.walls[k], scene)) {
      warn(k,
           "moves along itself, and drags along disks that hit it, but not disks that rest on it: method pairwise "
           "supports a pile without friction");
    }
  }
  return warnings;
}

}  // namespace carom
