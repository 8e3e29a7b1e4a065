// Times of events with a side or with another path in cases that are rare in runs: at rest along a periodic side, at a
// sink that the disk leaves, and with an image that is not the nearest one.
#include "core/physics/exact_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// There is one event for each axis: the disk has moved by a quarter of the period, 3, towards the side to which it
// moves. From rest it falls that far in sqrt(2 3 / g). For a disk that moves up the time is a lower bound, from 3 = v t
// + g t^2 / 2.
TEST(TimeToCrossing, IsThatOfAQuarterOfThePeriod) {
  const Domain box = test::box_of(8.0, 12.0, test::Periodic::both);
  const Gravity g(1.5);
  const auto time = [&](Side side, double vx, double vy, const Gravity& falls) {
    return time_to_crossing(side, {0.0, 5.0, 5.0, vx, vy}, box, falls);
  };
  EXPECT_DOUBLE_EQ(time(Side::bottom, 1.0, 0.0, g), 2.0);
  EXPECT_EQ(time(Side::top, 1.0, 0.0, g), never);
  EXPECT_DOUBLE_EQ(time(Side::bottom, 1.0, -1.25, g), 4.0 / 3.0);  // 3 = 1.25 t + 0.75 t^2
  EXPECT_DOUBLE_EQ(time(Side::top, 1.0, 1.25, g), 4.0 / 3.0);
  EXPECT_EQ(time(Side::bottom, 1.0, 1.25, g), never);
  EXPECT_DOUBLE_EQ(time(Side::right, 0.5, 1.0, g), 4.0);
  EXPECT_EQ(time(Side::left, 0.5, 1.0, g), never);
  EXPECT_EQ(time(Side::left, 0.0, 1.0, g), never);
  EXPECT_DOUBLE_EQ(time(Side::left, 0.0, 1.0, {1.0, 0.0}), 2.0);
  EXPECT_EQ(time(Side::right, 0.0, 1.0, {1.0, 0.0}), never);
  EXPECT_DOUBLE_EQ(time(Side::top, 0.0, 2.0, 0.0), 1.5);
}

// A sink takes a disk that touches it, even if the disk moves away.
TEST(SideTime, OfASinkIsNowWhereADiskTouchesIt) {
  Domain box = test::box_of(8.0, 12.0);
  box.sides[1] = SideKind::sink;
  const auto time = [&](double x, double vx) {
    return side_time({0.25, x, 5.0, vx, 0.0}, Side::right, 1.0, box, 0.0, 9.0);
  };
  EXPECT_EQ(time(7.0, -1.0), 0.25);
  EXPECT_EQ(time(7.5, -1.0), 0.25);
  EXPECT_EQ(time(6.5, -1.0), never);
  EXPECT_EQ(time(6.5, 1.0), 0.75);
  box.sides[1] = SideKind::wall;
  EXPECT_EQ(time(7.0, -1.0), never);
}

// The box is 4 high and wide. A disk of radius 0.5 flies away from the nearest image of another one, 1.5 away along
// each axis, and into the image behind it, 2.5 away.
TEST(TimeToContact, IsThatOfTheImageBehindTheNearest) {
  const Domain box = test::box_of(4.0, 4.0, test::Periodic::both);
  const auto time = [&](double dx, double dy, double vx, double vy, double end = 9.0) {
    return collision_time({0.0, 0.5, 0.5, 0.0, 0.0}, {0.0, 0.5 + dx, 0.5 + dy, vx, vy}, 1.0, box, 0.0, end);
  };
  for (const double end : {9.0, 1.5 + 1e-9}) {
    EXPECT_DOUBLE_EQ(time(1.5, 0.0, 1.0, 0.0, end), 1.5);
    EXPECT_DOUBLE_EQ(time(-1.5, 0.0, -1.0, 0.0, end), 1.5);
    EXPECT_DOUBLE_EQ(time(0.0, 1.5, 0.0, 1.0, end), 1.5);
    EXPECT_DOUBLE_EQ(time(0.0, -1.5, 0.0, -1.0, end), 1.5);
  }
  EXPECT_EQ(time(1.5, 0.0, 1.0, 0.0, 1.4), never);
  const double diagonal = 2.5 - std::sqrt(0.5);
  EXPECT_NEAR(time(1.5, 1.5, 1.0, 1.0), diagonal, 1e-14);
  EXPECT_NEAR(time(-1.5, 1.5, -1.0, 1.0), diagonal, 1e-14);
  // Disks that overlap, as they may by rounding, meet now.
  EXPECT_EQ(time_to_contact({0.9, 0.0, -1.0, 0.0}, 1.0), 0.0);
  EXPECT_EQ(time_to_contact({0.9, 0.0, 1.0, 0.0}, 1.0), never);
}

// In a shear flow the images in a disk's own row are as in a box without shear.
TEST(TimeToContact, InAFlowIsThatOfTheImageInItsRowToo) {
  Domain box = test::box_of(4.0, 40.0, test::Periodic::both);
  box.shear = {0.25, 10.0, 0.75};
  for (const double sign : {1.0, -1.0}) {
    const PathSegment q{0.0, 2.0 + 1.5 * sign, 20.0, sign, 0.0};
    EXPECT_DOUBLE_EQ(collision_time({0.0, 2.0, 20.0, 0.0, 0.0}, q, 1.0, box, 0.0, 1.75), 1.5);
  }
}

// The images in the row above move by the jump: the contact is where the image will be then.
TEST(TimeToContact, InAFlowIsThatOfTheImageThatMoves) {
  Domain box = test::box_of(40.0, 4.0, test::Periodic::both);
  box.shear.rate = 0.25;
  box.shear.jump = 1.0;
  box.shear.offset = -2.0;  // -1.5 at the start of the paths
  // The disk moves up by 2.5 in a time of 1.5 until contact; the image below starts from -offset, moves with -jump, and
  // is met head-on.
  const double t = collision_time({0.5, 10.0, 0.5, 0.0, 0.0}, {0.5, 8.5, 2.0, 1.0, 1.0}, 1.0, box, 0.0, 9.0);
  EXPECT_DOUBLE_EQ(t, 2.0);
  const double back = collision_time({0.5, 10.0, 3.5, 0.0, 0.0}, {0.5, 11.5, 2.0, -1.0, -1.0}, 1.0, box, 0.0, 9.0);
  EXPECT_DOUBLE_EQ(back, 2.0);
}

}  // namespace
}  // namespace carom
