// The cells of obstacles: each disk finds every obstacle that it touches, wherever it is and whatever its size.
#include "core/disks/obstacle_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/physics/obstacle_contact.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

std::vector<Obstacle> random_obstacles(test::Draws& draws, std::size_t n, const Domain& box) {
  std::vector<Obstacle> all;
  for (std::size_t k = 0; k < n; ++k) {
    Obstacle o;
    o.x = draws.in(0.0, box.width);
    o.y = draws.in(0.0, box.height);
    if (k % 2 == 0) {
      o.radius = draws.decades(0.01, 2.0);
    } else {
      o.kind = ObstacleKind::wall;
      o.dx = draws.in(-0.3, 0.3) * box.width;
      o.dy = draws.in(-0.3, 0.3) * box.height;
    }
    all.push_back(o);
  }
  return all;
}

// The shortest distance, found by trying all images within a period.
bool touches(const Obstacle& o, double x, double y, double r, const Domain& box) {
  bool any = false;
  const int periods_x = box.periodic_x() ? 1 : 0;
  const int periods_y = box.periodic_y() ? 1 : 0;
  for (int kx = -periods_x; kx <= periods_x; ++kx) {
    for (int ky = -periods_y; ky <= periods_y; ++ky) {
      const double px = x - (o.x + kx * box.width);
      const double py = y - (o.y + ky * box.height);
      const double length2 = o.dx * o.dx + o.dy * o.dy;
      const double along = length2 > 0.0 ? std::clamp((px * o.dx + py * o.dy) / length2, 0.0, 1.0) : 0.0;
      any = any || std::hypot(px - along * o.dx, py - along * o.dy) <= r + o.radius;
    }
  }
  return any;
}

// Few obstacles, far from most disks, and many obstacles; disks much smaller than a cell, and disks larger than several
// cells.
TEST(ObstacleCells, FindAllThatADiskTouches) {
  for (const bool periodic : {false, true}) {
    for (const std::size_t n : {1U, 2U, 7U, 300U}) {
      test::Draws draws(n);
      Domain box;
      box.width = 40.0;
      box.height = 25.0;
      if (periodic) box.sides.fill(SideKind::periodic);
      const std::vector<Obstacle> obstacles = random_obstacles(draws, n, box);
      const auto cells = place_obstacles(obstacles, box);
      std::size_t found = 0;
      std::size_t clear = 0;
      for (int k = 0; k < 2000; ++k) {
        const double r = draws.decades(0.01, 6.0);
        const double x = draws.in(0.0, box.width);
        const double y = draws.in(0.0, box.height);
        std::vector<int> times(n, 0);
        for_each_obstacle_touched(box, x, y, r, [&](std::uint32_t o, const ObstacleGap&) { ++times[o]; });
        const bool is_clear = cells->is_clear({x - r, y - r}, {x + r, y + r});
        clear += is_clear ? 1 : 0;
        for (std::size_t o = 0; o < n; ++o) {
          ASSERT_FALSE(is_clear && times[o] > 0) << "obstacle " << o << " of " << n;
          ASSERT_EQ(times[o], touches(obstacles[o], x, y, r, box) ? 1 : 0) << "obstacle " << o << " of " << n;
          found += static_cast<std::size_t>(times[o]);
        }
      }
      EXPECT_GT(found, 10U * n);
      if (n <= 7) {
        EXPECT_GT(clear, 50U) << "too few disks are clear of the few obstacles";
      }
    }
  }
}

// A wall that moves along x, once around the period in a unit of time.
struct WindingWall {
  Domain box;
  std::unique_ptr<ObstacleCells> cells;

  WindingWall() {
    box.width = box.height = 8.0;
    box.sides = {SideKind::periodic, SideKind::periodic, SideKind::wall, SideKind::wall};
    box.inner_walls_move = true;
    Obstacle wall;
    wall.kind = ObstacleKind::wall;
    wall.x = wall.y = 2.0;
    wall.dy = 3.0;
    wall.moves = true;
    WallMotion motion;
    motion.pace.kind = SideMotion::Kind::steady;
    motion.pace.speed = 1.0;
    motion.along = {8.0, 0.0};
    cells = place_obstacles({wall}, box, {motion});
  }
  bool touches_at(double x) const { return touches_obstacle(box, x, 3.0, 0.25); }
};

// The number of rounds may exceed 32 bits.
TEST(ObstacleCells, FindAWallThatHasGoneRoundVeryOften) {
  for (const double rounds : {1.0, 0x1p31, 0x1p31 + 5.0, 0x1p32, 0x1p33 + 1.0, 0x1p40}) {
    WindingWall wall;
    wall.box.move_walls(rounds);
    wall.cells->follow(rounds, rounds);
    EXPECT_TRUE(wall.touches_at(2.125)) << rounds;
    EXPECT_FALSE(wall.touches_at(2.5)) << rounds;
  }
}

// A step without disks may have any length: the number of cells does not grow with it.
TEST(ObstacleCells, FindAWallThatGoesRoundVeryOftenInAStep) {
  WindingWall wall;
  step_walls(wall.box, wall.cells.get(), 0.0, 1e12);
  EXPECT_TRUE(wall.touches_at(2.125));
  EXPECT_FALSE(wall.touches_at(2.5));
}

}  // namespace
}  // namespace carom
