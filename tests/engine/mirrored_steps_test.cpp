// Steps of mirrored scenes mirror each other if disks just touch at the start of a step, or were pushed into a side:
// rounding, which differs between the four sides, must not decide.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// Coordinates relative to a side, looking into the box: `off` is the distance from the side, `along` the place along
// it.
struct AtSide {
  double off = 0.0, along = 0.0;
};

Disk disk_at(Side side, const Domain& box, double radius, AtSide place, AtSide velocity) {
  Disk d;
  d.radius = radius;
  d.mass = 1.0;
  const bool across = side == Side::left || side == Side::right;
  (across ? d.x : d.y) = place.off;
  (across ? d.y : d.x) = place.along;
  (across ? d.vx : d.vy) = velocity.off;
  (across ? d.vy : d.vx) = velocity.along;
  if (side == Side::right) d.x = box.width - d.x;
  if (side == Side::top) d.y = box.height - d.y;
  if (side == Side::right) d.vx = -d.vx;
  if (side == Side::top) d.vy = -d.vy;
  return d;
}

// The distance of disk `id` from the side.
double distance_to(Side side, const Domain& box, const Disks& disks, DiskId id) {
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (disks.id[i] != id) continue;
    const double c = side == Side::left || side == Side::right ? disks.x[i] : disks.y[i];
    return side == Side::left || side == Side::bottom ? c : (side == Side::right ? box.width : box.height) - c;
  }
  return HUGE_VAL;
}

State after_a_step(const Scene& scene, const State& start, bool reference) {
  const auto engine =
      reference ? make_reference_engine(scene, start) : make_parallel_engine(scene, start, Threads{2, 1});
  engine->step();
  return engine->state();
}

// Two disks at rest, overlapping by 3 % of their radii, one of which presses the other into a side: the overlap that
// remains at the side must be the same for all sides.
TEST(MirroredSteps, DisksArePushedIntoEachSideAlike) {
  test::Draws draws(1);
  for (int k = 0; k < 100; ++k) {
    const double r = draws.in(0.2, 1.0);
    const Scene scene = test::scene_of(Method::pairwise, draws.in(8.0, 12.0), draws.in(8.0, 12.0), 0.01, 1.0);
    const double along = draws.in(2.0, 6.0);
    std::vector<double> distances;
    for (const Side side : all_sides) {
      const State start = test::state_of(
          {disk_at(side, scene.box, r, {0.9999 * r, along}, {}), disk_at(side, scene.box, r, {2.9399 * r, along}, {})});
      for (const bool reference : {true, false}) {
        distances.push_back(distance_to(side, scene.box, after_a_step(scene, start, reference).disks, 0));
      }
    }
    for (const double d : distances) EXPECT_NEAR(d, distances[0], 1e-12) << "radius " << r;
  }
}

// A disk that just touches a side at the start of a step, and moves into it, must bounce within the step, at all sides.
TEST(MirroredSteps, WhatJustTouchesASideBouncesWithinTheStep) {
  test::Draws draws(2);
  for (const Method method : test::stepping_methods) {
    for (int k = 0; k < 100; ++k) {
      const double r = draws.in(0.2, 1.0);
      const double v = draws.in(0.1, 3.0);
      const Scene scene = test::scene_of(method, draws.in(8.0, 12.0), draws.in(8.0, 12.0), 0.01, 1.0);
      for (const Side side : all_sides) {
        const State start = test::state_of({disk_at(side, scene.box, r, {r, draws.in(2.0, 6.0)}, {-v, 0.3})});
        for (const bool reference : {true, false}) {
          const State end = after_a_step(scene, start, reference);
          EXPECT_NEAR(distance_to(side, scene.box, end.disks, 0), r + 0.01 * v, 1e-12) << "radius " << r;
          EXPECT_EQ(end.validity.inaccurate_at_walls, 0U);
        }
      }
    }
  }
}

// The same for two disks that just touch, with any direction of the line of centres, and for a fixed disk: they collide
// within the step, and not late.
TEST(MirroredSteps, WhatJustTouchAndApproachCollideWithinTheStep) {
  test::Draws draws(3);
  const Scene scene = test::scene_of(Method::pairwise, 10.0, 10.0, 0.01, 1.0);
  for (int k = 0; k < 100; ++k) {
    const double r = draws.in(0.2, 1.0);
    const double v = draws.in(0.1, 3.0);
    const double turn = draws.in(0.0, 6.28);
    const Vec2 n{std::cos(turn), std::sin(turn)};
    Disk one{5.0 - r * n.x, 5.0 - r * n.y, v * n.x, v * n.y, r, 1.0};
    Disk other{5.0 + r * n.x, 5.0 + r * n.y, -v * n.x, -v * n.y, r, 1.0};
    const State of_disks = test::state_of({one, other});
    State at_obstacle = test::state_of({one});
    at_obstacle.obstacles.push_back({other.x, other.y, 0.0, 0.0, r, 1.0, 1});
    for (const bool reference : {true, false}) {
      const State apart = after_a_step(scene, of_disks, reference);
      const double distance = std::hypot(apart.disks.x[1] - apart.disks.x[0], apart.disks.y[1] - apart.disks.y[0]);
      EXPECT_NEAR(distance, 2.0 * (r + 0.01 * v), 1e-12) << "radius " << r;
      EXPECT_EQ(apart.validity.inaccurate, 0U);
      const State away = after_a_step(scene, at_obstacle, reference);
      EXPECT_NEAR(std::hypot(away.disks.x[0] - other.x, away.disks.y[0] - other.y), 2.0 * r + 0.01 * v, 1e-12);
    }
  }
}

}  // namespace
}  // namespace carom
