#include "core/start/wall_segments.hpp"

namespace carom {

std::vector<Obstacle> segments_of(const Scene& scene) {
  std::vector<Obstacle> segments;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    const InnerWall& wall = scene.walls[w];
    const ObstacleKind kind = wall.sink ? ObstacleKind::sink : ObstacleKind::wall;
    for (std::size_t k = 1; k < wall.points.size(); ++k) {
      const Vec2 from = wall.points[k - 1];
      const Vec2 to = wall.points[k];
      segments.push_back({from.x, from.y, to.x - from.x, to.y - from.y, 0.0, wall.restitution, static_cast<DiskId>(w),
                          kind, wall.motion.moves()});
    }
  }
  return segments;
}

}  // namespace carom
