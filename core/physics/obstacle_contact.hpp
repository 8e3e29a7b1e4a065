// A disk and an obstacle, as time stepping sees them: how deep one lies in the other, since when, and what the obstacle
// does. An obstacle is a wall that is curved: the formulas of boundary.hpp along the line of centres.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/disks/obstacle_cells.hpp"
#include "core/physics/advance.hpp"
#include "core/physics/disk_pair.hpp"

namespace carom {

struct ObstacleGap {
  double nx, ny;  // unit vector from the obstacle to the disk
  double beyond;  // how far the disk's edge reaches beyond the obstacle's; length, >= 0: they touch
};

// The nearest image. Coincident centres: upwards.
inline ObstacleGap gap_to(const Obstacle& o, double x, double y, double r, const Domain& box) {
  const Vec2 apart = nearest_image({x - o.x, y - o.y}, box);
  const double distance = std::sqrt(apart.x * apart.x + apart.y * apart.y);
  const double nx = distance > 0.0 ? apart.x / distance : 0.0;
  const double ny = distance > 0.0 ? apart.y / distance : 1.0;
  return {nx, ny, (r + o.radius) - distance};
}

// Of the images of an obstacle, is the one displaced by shift the nearest to (x, y)? Images lie whole periods apart.
inline bool is_nearest_image(const Obstacle& o, double x, double y, Vec2 shift, const Domain& box) {
  const Vec2 apart = nearest_image({x - o.x, y - o.y}, box);
  return std::abs((x - o.x - shift.x) - apart.x) < 0.5 * box.width &&
         std::abs((y - o.y - shift.y) - apart.y) < 0.5 * box.height;
}

// Calls found(k, gap) once for each obstacle k that a disk of radius r at (x, y) overlaps or touches.
// Precondition: box.obstacles is not null.
template <class Found>
void for_each_obstacle_touched(const Domain& box, double x, double y, double r, Found&& found) {
  box.obstacles->visit({x - r, y - r}, {x + r, y + r}, [&](std::uint32_t k, Vec2 shift) {
    const Obstacle& o = (*box.obstacles)[k];
    const ObstacleGap gap = gap_to(o, x, y, r, box);
    if (gap.beyond >= 0.0 && is_nearest_image(o, x, y, shift, box)) found(k, gap);
  });
}

// Does a disk overlap or touch any obstacle?
inline bool touches_obstacle(const Domain& box, double x, double y, double r) {
  bool touched = false;
  if (box.obstacles != nullptr) {
    for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t, const ObstacleGap&) { touched = true; });
  }
  return touched;
}

// Speed towards the obstacle; > 0: the disk moves into it.
inline double speed_towards(const ObstacleGap& gap, double vx, double vy) {
  return -(vx * gap.nx + vy * gap.ny);
}

// Time since the disk touched the obstacle, on its present path; infinity when this path never did. Without gravity
// the root of a quadratic (touching_time); with it, two steps by Newton from there, which leave an error of the order
// of g^2 dt^4: it shifts the place of the impact, not the energy, as the disk goes back and forth on its own parabola.
// Preconditions: gap.beyond >= 0 and speed_towards > 0 at (x, y).
inline double time_since_obstacle(const Obstacle& o, const ObstacleGap& gap, double r, double vx, double vy, double g) {
  const double contact = r + o.radius;
  const double distance = contact - gap.beyond;
  const double dx = distance * gap.nx;
  const double dy = distance * gap.ny;
  double ago = std::max(0.0, -touching_time({-dx, -dy, -vx, -vy}, contact));
  if (g == 0.0 || ago == HUGE_VAL) return ago;
  for (int step = 0; step < 2; ++step) {
    double x = dx;
    double y = dy;
    double ux = vx;
    double uy = vy;
    drift<true>(x, y, ux, uy, -ago, g);
    const double approach = x * ux + y * uy;
    if (!(approach < 0.0)) return ago;
    ago = std::max(0.0, ago + (x * x + y * y - contact * contact) / (2.0 * approach));
  }
  return ago;
}

}  // namespace carom
