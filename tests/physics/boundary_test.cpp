// Walls with and without gravity, their restitution, the nearest image, and wrapping.
#include "core/physics/boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/advance.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

using test::box_of;
using test::Periodic;

// A disk reaches a wall if x - r <= 0, and so on: touching counts, and the sign says whether it is inside or beyond.
TEST(Walls, ReachBeyondEachSide) {
  const Domain box = box_of(10.0, 20.0);
  EXPECT_EQ(reach_beyond(Side::left, 1.0, 5.0, 1.0, box), 0.0);
  EXPECT_EQ(reach_beyond(Side::right, 9.5, 5.0, 1.0, box), 0.5);
  EXPECT_EQ(reach_beyond(Side::bottom, 5.0, 0.25, 1.0, box), 0.75);
  EXPECT_EQ(reach_beyond(Side::top, 5.0, 18.0, 1.0, box), -1.0);
}

TEST(Walls, SpeedTowardsAndBounceOffEachSide) {
  for (Side side : all_sides) {
    double vx = side == Side::left ? -2.0 : 2.0;
    double vy = side == Side::bottom ? -3.0 : 3.0;
    const bool across_x = side == Side::left || side == Side::right;
    const double speed = across_x ? 2.0 : 3.0;
    EXPECT_EQ(outward_speed(side, vx, vy), speed);
    const double kept = across_x ? vy : vx;
    bounce(side, 0.25, vx, vy);
    EXPECT_EQ(outward_speed(side, vx, vy), -0.25 * speed);
    EXPECT_EQ(across_x ? vy : vx, kept);
  }
}

TEST(Walls, TouchingCoordinateTouches) {
  const Domain box = box_of(10.0, 20.0);
  for (Side side : all_sides) {
    const bool across_x = side == Side::left || side == Side::right;
    const double x = across_x ? touching_coordinate(side, 1.5, box) : 5.0;
    const double y = across_x ? 5.0 : touching_coordinate(side, 1.5, box);
    EXPECT_EQ(reach_beyond(side, x, y, 1.5, box), 0.0);
  }
}

TEST(Walls, TimeSinceWithoutGravity) {
  for (Side side : all_sides) EXPECT_EQ(time_since_wall(side, 0.5, 2.0, 0.0), 0.25);
  EXPECT_EQ(time_since_wall(Side::left, 0.5, 2.0, 9.0), 0.25);  // gravity does not act along x
  EXPECT_EQ(time_since_wall(Side::right, 0.5, 2.0, 9.0), 0.25);
  EXPECT_EQ(time_since_wall(Side::bottom, 0.0, 2.0, 9.0), 0.0);  // just touching
}

// A disk starts on the wall and drifts by t under gravity; then the time found must be t. At the ceiling the disk must
// still be going up.
TEST(Walls, TimeSinceWithGravityUndoesTheDrift) {
  test::Draws draws(1);
  for (int k = 0; k < 5000; ++k) {
    const Side side = k % 2 == 0 ? Side::bottom : Side::top;
    const double g = draws.decades(1e-6, 10.0);
    const double t = draws.decades(1e-4, 1.0);
    const double into = side == Side::bottom ? draws.decades(1e-3, 10.0) : g * t * (1.0 + draws.decades(1e-2, 100.0));
    double x = 0.0, y = 0.0, vx = 0.0;
    double vy = side == Side::bottom ? -into : into;
    drift<true>(x, y, vx, vy, t, g);
    const double beyond = std::abs(y);
    const double speed = outward_speed(side, vx, vy);
    ASSERT_GT(speed, 0.0);
    EXPECT_NEAR(time_since_wall(side, beyond, speed, g) / t, 1.0, 1e-12);
  }
}

// A disk deeper below the floor than its speed can have carried it was pushed there: its path was never inside the box.
TEST(Walls, NeverInsideIsInfinity) {
  EXPECT_EQ(time_since_wall(Side::bottom, 1.0, 1.0, 0.75), HUGE_VAL);
  EXPECT_TRUE(std::isfinite(time_since_wall(Side::bottom, 1.0, 1.0, 0.5)));
}

// An engine runs one disk against each wall: it comes back with -wall_restitution times its speed, from the wall and at
// the time of contact, not from beyond the wall and not at the end of the step.
TEST(Walls, EnginesReflectAtTheWallWithItsRestitution) {
  for (Method method : test::stepping_methods) {
    for (const double restitution : {1.0, 0.5}) {
      Scene scene = test::scene_of(method, 10.0, 10.0, 0.1, 6.0);
      scene.box.restitutions.fill(restitution);
      const State end = test::run(scene, test::state_of(scene, {{7.0, 5.0, 0.53, 0.0, 1.0, 1.0}}));
      const double hit = 2.0 / 0.53;
      EXPECT_NEAR(end.disks.vx[0], -restitution * 0.53, 1e-15);
      EXPECT_NEAR(end.disks.x[0], 9.0 - restitution * 0.53 * (6.0 - hit), 1e-13) << test::name_of(method);
      EXPECT_EQ(end.counters.wall_collisions, 1U);
      EXPECT_NEAR(end.counters.wall_impulse[1], (1.0 + restitution) * 0.53, 1e-15);
    }
  }
}

TEST(NearestImage, ShortestWayAndAntisymmetric) {
  EXPECT_EQ(nearest_image(6.0, 10.0), -4.0);
  EXPECT_EQ(nearest_image(-6.0, 10.0), 4.0);
  EXPECT_EQ(nearest_image(5.0, 10.0), 5.0);
  EXPECT_EQ(nearest_image(-5.0, 10.0), -5.0);
  test::Draws draws(2);
  for (int k = 0; k < 2000; ++k) {
    const double period = draws.decades(1e-3, 1e3);
    const double d = draws.in(-1.49, 1.49) * period;
    EXPECT_EQ(nearest_image(-d, period), -nearest_image(d, period));
    EXPECT_LE(std::abs(nearest_image(d, period)), 0.5 * period);
  }
}

TEST(WrapCoordinate, HalfOpenInterval) {
  EXPECT_EQ(wrap(10.0, 10.0), 0.0);
  EXPECT_EQ(wrap(0.0, 10.0), 0.0);
  EXPECT_EQ(wrap(-1e-20, 10.0), 0.0);  // -1e-20 + 10 rounds to 10, which is outside
  EXPECT_EQ(wrap(-0.5, 10.0), 9.5);
  EXPECT_EQ(wrap(10.5, 10.0), 0.5);
  EXPECT_EQ(wrap(std::nextafter(10.0, 0.0), 10.0), std::nextafter(10.0, 0.0));
  test::Draws draws(3);
  for (int k = 0; k < 5000; ++k) {
    const double period = draws.decades(1e-6, 1e6);
    const double c = k % 2 == 0 ? draws.in(-period, 2.0 * period) : -draws.decades(1e-40, 1e-10) * period;
    const double w = wrap(c, period);
    EXPECT_GE(w, 0.0);
    EXPECT_LT(w, period);
  }
}

// The images above are offset to the right: a disk that leaves through the top enters at the bottom, shifted to the
// left by the offset. A disk below 0 by less than the rounding of the height is put at 0, and has not crossed the side.
TEST(WrapSheared, MovesAlongByTheOffset) {
  const Domain box = box_of(20.0, 10.0, Periodic::both);
  const auto expect = [&](Vec2 from, Vec2 to, double rows) {
    EXPECT_EQ(wrap_sheared(from.x, from.y, 3.0, box), rows) << from.y << " to " << to.y;
    EXPECT_EQ(from, to);
  };
  expect({5.0, 10.5}, {2.0, 0.5}, -1);
  expect({5.0, 10.0}, {2.0, 0.0}, -1);
  expect({5.0, -0.5}, {8.0, 9.5}, 1);
  expect({19.0, -0.5}, {2.0, 9.5}, 1);
  expect({5.0, -1e-20}, {5.0, 0.0}, 0);
  expect({-1.0, 4.0}, {19.0, 4.0}, 0);
  // Steps that are far too long: the disk moves further than the box is high.
  expect({5.0, -10.0}, {8.0, 0.0}, 1);
  expect({5.0, 20.0}, {19.0, 0.0}, -2);
  expect({5.0, 47.5}, {13.0, 7.5}, -4);
  expect({5.0, -10.5}, {11.0, 9.5}, 2);
}

// Sides that are no walls have a restitution, too, but nothing bounces there.
TEST(Walls, DissipateWhereSidesAreWalls) {
  Domain box = box_of(10.0, 10.0, Periodic::both);
  box.restitutions.fill(0.5);
  EXPECT_FALSE(box.walls_dissipate());
  box.sides[static_cast<std::size_t>(Side::top)] = SideKind::sink;
  EXPECT_FALSE(box.walls_dissipate());
  box.sides[static_cast<std::size_t>(Side::top)] = SideKind::wall;
  EXPECT_TRUE(box.walls_dissipate());
  box.restitutions[static_cast<std::size_t>(Side::top)] = 1.0;
  EXPECT_FALSE(box.walls_dissipate());
}

}  // namespace
}  // namespace carom
