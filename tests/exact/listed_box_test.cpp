// Places in the box as whole numbers, and back.
#include "parallel/exact/listed_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// Periodic along x, between walls along y.
ListedBox half_periodic() {
  return ListedBox(test::box_of(20.0, 10.0, true, false));
}

TEST(ListedBox, RoundsPlacesDownByLessThanAUnit) {
  const ListedBox box = half_periodic();
  for (const double x : {0.0, 1e-9, 3.7, 19.999999}) {
    const Vec2 there = box.position_of(box.fixed_point(x, 0.5 * x));
    EXPECT_LE(there.x, x);
    EXPECT_LT(x - there.x, box.unit.x);
    EXPECT_LE(there.y, 0.5 * x);
    EXPECT_LT(0.5 * x - there.y, box.unit.y);
  }
}

TEST(ListedBox, WrapsAlongAPeriodAndKeepsToWalls) {
  const ListedBox box = half_periodic();
  EXPECT_EQ(box.fixed_point(20.0, 5.0).x, 0U);
  EXPECT_EQ(box.fixed_point(-5.0, 5.0).x, box.fixed_point(15.0, 5.0).x);
  EXPECT_EQ(box.fixed_point(5.0, -1.0).y, 0U);
  EXPECT_EQ(box.position_of(box.fixed_point(5.0, 11.0)).y, 10.0);
}

TEST(ListedBox, TakesTheNearestImageAlongAPeriodAlone) {
  const Vec2 d = half_periodic().nearest_image_of({-12.0, 8.0});
  EXPECT_DOUBLE_EQ(d.x, 8.0);
  EXPECT_EQ(d.y, 8.0);
}

TEST(ListedBox, IsLeftAlongAPeriodAlone) {
  const ListedBox box = half_periodic();
  EXPECT_FALSE(box.is_outside(0.0, -1.0));
  EXPECT_FALSE(box.is_outside(19.0, 11.0));
  EXPECT_TRUE(box.is_outside(20.0, 5.0));
  EXPECT_TRUE(box.is_outside(-0.1, 5.0));
}

TEST(ListedBox, DepthIsThatOfThePlaceWhereADiskIsListed) {
  const ListedBox box = half_periodic();
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 2.0).x, 3.0);
  EXPECT_EQ(box.depth_beyond_border({-3.0, 5.0}, {17.0, 5.0}, 2.0).x, 3.0);
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 3.5).x, 0.0) << "near the border";
  EXPECT_EQ(box.depth_beyond_border({3.0, 5.0}, {3.0, 5.0}, 2.0).x, 0.0) << "in the box";
  EXPECT_EQ(box.depth_beyond_border({23.0, 11.0}, {3.0, 9.0}, 0.5).y, 0.0) << "walls are no border";
}

}  // namespace
}  // namespace carom
