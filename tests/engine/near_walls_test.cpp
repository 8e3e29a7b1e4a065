// The kernel that finds the disks near walls and obstacles: in every version it finds the same disks as WallReach,
// which tests them one by one.
#include "parallel/stepping/near_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "parallel/stepping/wall_reach.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

// Disks anywhere in the box and a little beyond it.
Disks drawn_disks(test::Draws& draws, const Domain& box, bool unequal) {
  Disks d;
  d.common_radius = 0.2;
  for (DiskId id = 0; id < 1'003; ++id) {
    d.id.push_back(id);
    d.x.push_back(draws.in(-0.3, box.width + 0.3));
    d.y.push_back(draws.in(-0.3, box.height + 0.3));
    d.vx.push_back(0.0);
    d.vy.push_back(0.0);
    if (unequal) d.radius.push_back(draws.in(0.01, 0.4));
  }
  return d;
}

// Returns the largest number of disks found.
std::size_t expect_same_disks(const Domain& box, bool unequal) {
  test::Draws draws(41);
  const Disks d = drawn_disks(draws, box, unequal);
  const WallReach reach(box);
  std::size_t found = 0;
  for (const auto& [begin, end] : {std::pair{0UL, d.size()}, {1UL, 4UL}, {17UL, 17UL}, {3UL, 602UL}}) {
    std::vector<std::uint32_t> expected{7};  // a previous entry: the kernel appends
    for (std::size_t i = begin; i < end; ++i) {
      if (reach.touches(d.x[i], d.y[i], d.radius_of(i))) expected.push_back(static_cast<std::uint32_t>(i));
    }
    for (const NearWallsKernel kernel : {choose_near_walls_kernel(), near_walls_baseline}) {
      std::vector<std::uint32_t> near{7};
      kernel(near_walls_input(d, box), begin, end, near);
      EXPECT_EQ(near, expected) << begin;
    }
    found = std::max(found, expected.size());
  }
  return found;
}

Domain box_with_walls(bool at_left_and_right) {
  Domain box;
  box.width = 12.0;
  box.height = 9.0;
  box.sides.fill(SideKind::wall);
  if (!at_left_and_right) {
    box.sides[static_cast<std::size_t>(Side::left)] = SideKind::periodic;
    box.sides[static_cast<std::size_t>(Side::right)] = SideKind::periodic;
  }
  return box;
}

TEST(NearWalls, AreThoseOfWallReach) {
  for (const bool at_left_and_right : {false, true}) {
    for (const bool unequal : {false, true}) {
      const std::size_t found = expect_same_disks(box_with_walls(at_left_and_right), unequal);
      EXPECT_GT(found, 30);
      EXPECT_LT(found, 500);
    }
  }
}

// Two fixed disks and two segments, one of which may move.
TEST(NearWalls, AreThoseOfWallReachAmongObstacles) {
  for (const bool moves : {false, true}) {
    for (const bool unequal : {false, true}) {
      Domain box = box_with_walls(false);
      std::vector<Obstacle> obstacles(4);
      obstacles[0].x = 3.0, obstacles[0].y = 4.0, obstacles[0].radius = 0.5;
      obstacles[1].x = 11.9, obstacles[1].y = 6.0, obstacles[1].radius = 0.3;
      obstacles[2].x = 6.0, obstacles[2].y = 2.0, obstacles[2].dx = 2.0, obstacles[2].dy = 1.0;
      obstacles[3].x = 5.0, obstacles[3].y = 6.0, obstacles[3].dx = 1.0, obstacles[3].dy = 0.0;
      for (const std::size_t k : {2UL, 3UL}) obstacles[k].kind = ObstacleKind::wall;
      std::vector<WallMotion> motions(1);
      if (moves) {
        obstacles[3].moves = true;
        motions[0].pace.kind = SideMotion::Kind::steady;
        motions[0].pace.speed = 1.0;
        motions[0].along = {0.5, 0.25};
        box.clock = {0.0, 1.0};
      }
      const std::unique_ptr<ObstacleCells> cells = place_obstacles(obstacles, box, motions);
      ASSERT_EQ(cells->clearances(), moves ? 2 : 1);
      const std::size_t found = expect_same_disks(box, unequal);
      EXPECT_GT(found, 80);
      EXPECT_LT(found, 700);
    }
  }
}

}  // namespace
}  // namespace carom
