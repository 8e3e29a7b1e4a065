// The clearance of places among the obstacles of a run, at rest and moving: at most the distance at any time of the
// step or window, and not much smaller.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/disks/obstacle_cells.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"

namespace carom {
namespace {

Domain box_of(bool periodic) {
  return test::box_of(40.0, 25.0, periodic ? test::Periodic::both : test::Periodic::none);
}

WallMotion steady(Vec2 velocity) {
  WallMotion motion;
  motion.pace.kind = SideMotion::Kind::steady;
  motion.pace.speed = 1.0;
  motion.along = velocity;
  return motion;
}

WallMotion vibrating(SideMotion::Kind kind, Vec2 amplitude, double period) {
  WallMotion motion;
  motion.pace.kind = kind;
  motion.pace.amplitude = 1.0;
  motion.pace.period = period;
  motion.along = amplitude;
  return motion;
}

// Two fixed disks, and one wall for each of the motions.
std::vector<Obstacle> obstacles_of(std::size_t motions) {
  std::vector<Obstacle> all(2 + motions);
  all[0].x = 3.0, all[0].y = 4.0, all[0].radius = 0.5;
  all[1].x = 38.9, all[1].y = 20.0, all[1].radius = 0.8;
  for (std::size_t k = 0; k < motions; ++k) {
    Obstacle& wall = all[2 + k];
    wall.kind = ObstacleKind::wall;
    wall.id = static_cast<DiskId>(k);
    wall.moves = true;
    wall.x = 12.0 + static_cast<double>(k), wall.y = 8.0;
    wall.dx = k % 2 == 0 ? 3.0 : 0.0, wall.dy = 7.0;
  }
  return all;
}

// The distance from an obstacle as it stands at time t, or from its images within two periods; length.
double distance_at(const ObstacleCells& cells, const std::vector<WallMotion>& motions, const Domain& box, Vec2 place,
                   double t) {
  const int periods = box.periodic_x() ? 2 : 0;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Obstacle o = at_time(cells[k], motions, t, box);
    for (int kx = -periods; kx <= periods; ++kx) {
      for (int ky = -periods; ky <= periods; ++ky) {
        const Vec2 apart{place.x - o.x - kx * box.width, place.y - o.y - ky * box.height};
        const double length2 = o.dx * o.dx + o.dy * o.dy;
        const double share = length2 > 0.0 ? std::clamp((apart.x * o.dx + apart.y * o.dy) / length2, 0.0, 1.0) : 0.0;
        least = std::min(least, std::hypot(apart.x - share * o.dx, apart.y - share * o.dy) - o.radius);
      }
    }
  }
  return least;
}

struct Case {
  const char* name;
  bool periodic;
  std::vector<WallMotion> motions;
  double from, to;   // the step or window; time
  double shortfall;  // the most by which the clearance may fall short of the distance; length
};

class ObstacleClearance : public testing::TestWithParam<Case> {};

TEST_P(ObstacleClearance, IsNoMoreThanTheDistanceAtAnyTime) {
  const Case& c = GetParam();
  const Domain box = box_of(c.periodic);
  ObstacleCells cells(obstacles_of(c.motions.size()), c.motions, box);
  cells.follow(1.0, 2.0);  // clearances of another time must be forgotten
  cells.follow(c.from, c.to);
  test::Draws draws(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec2 place{draws.in(0.0, box.width), draws.in(0.0, box.height)};
    const double known = cells.clearance(place);
    double nearest = HUGE_VAL;
    for (int m = 0; m <= 16; ++m) {
      nearest = std::min(nearest, distance_at(cells, c.motions, box, place, c.from + (c.to - c.from) * (m / 16.0)));
    }
    ASSERT_LE(known, std::max(nearest, 0.0) + 1e-9) << place.x << ' ' << place.y;
    ASSERT_GE(known, std::min(nearest, 8.0) - c.shortfall) << place.x << ' ' << place.y;
    ASSERT_EQ(cells.is_clear(place, place), known >= 0.0);
  }
  EXPECT_LT(cells.clearance({-0.1, 3.0}), 0.0) << "places out of the box have no clearance";
  EXPECT_LT(cells.clearance({3.0, box.height}), 0.0) << "places out of the box have no clearance";
}

// There are at least 64 by 64 cells, each at most 0.8 long. A place may be anywhere in its cell, and distances beyond
// are counted in cells along one axis only. With more than four different motions the swept area of walls is a
// rectangle.
const std::vector<WallMotion> five_ways{steady({0.1, 0.0}), steady({0.2, 0.0}), steady({0.3, 0.0}), steady({0.4, 0.0}),
                                        steady({0.5, 0.0})};
INSTANTIATE_TEST_SUITE_P(
    Motions, ObstacleClearance,
    testing::Values(Case{"None", true, {}, 0.0, 1.0, 4.0}, Case{"NoneBetweenWalls", false, {}, 0.0, 1.0, 4.0},
                    Case{"Steady", true, {steady({1.0, 0.5})}, 7.0, 7.1, 4.0},
                    Case{"ManyTimesRound", true, {steady({-31.0, 17.0})}, 1.0e6, 1.0e6 + 0.01, 4.2},
                    Case{"SteadyBetweenWalls", false, {steady({0.7, 0.3})}, 20.0, 20.2, 4.0},
                    Case{"BackBetweenWalls", false, {steady({-1.0, 0.0}), steady({-1.0, 0.0})}, 11.0, 11.1, 4.0},
                    Case{"Sine", false, {vibrating(SideMotion::Kind::sine, {0.0, 5.0}, 3.0)}, 5.2, 5.3, 5.0},
                    Case{"Parabolas", true, {vibrating(SideMotion::Kind::parabolas, {6.0, 1.0}, 2.0)}, 5.4, 5.6, 8.0},
                    Case{"TwoWays", true, {steady({1.0, 0.0}), steady({0.0, -2.0})}, 3.0, 3.1, 4.0},
                    Case{"FiveWays", true, five_ways, 3.0, 3.1, 16.0}),
    [](const testing::TestParamInfo<Case>& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace carom
