// The length of windows of the exact method: the longest that pays, from the speeds of disks, walls and flow, and the
// length that follows from the number of events in the window before.
#include "core/step/window_length.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/scene.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// A box of 100 disks whose spacing sqrt(A / n) is 2.
Scene scene_of_spacing_2() {
  return test::scene_of(Method::exact, 40.0, 10.0, 0.1, 1.0);
}

constexpr std::size_t disks = 100;

// The spacing over the root mean square speed of disks. Whatever else moves a disk on the way to its neighbour shortens
// this; speeds are added in squares.
TEST(WindowLength, IsTheTimeToANeighbour) {
  const Scene plain = scene_of_spacing_2();
  EXPECT_DOUBLE_EQ(longest_window(plain, {99.0, 9.0}, disks), 2.0 / 3.0);
  EXPECT_EQ(longest_window(plain, {0.0, 0.0}, disks), HUGE_VAL);
  Scene falls = plain;
  falls.physics.gravity = 4.0;  // 2 g d = 16
  EXPECT_DOUBLE_EQ(longest_window(falls, {99.0, 9.0}, disks), 2.0 / 5.0);
  Scene moves = plain;
  moves.box.motions[1] = {SideMotion::Kind::steady, 0.0, -4.0};
  EXPECT_DOUBLE_EQ(longest_window(moves, {99.0, 9.0}, disks), 2.0 / 5.0);
  Scene flows = plain;
  flows.box.shear.rate = 2.0;  // 4 over a distance of the spacing
  flows.box.shear.jump = 20.0;
  EXPECT_DOUBLE_EQ(longest_window(flows, {99.0, 9.0}, disks), 40.0 / (8.0 * 20.0));
  flows.box.width = 400.0, flows.box.height = 1.0;
  flows.box.shear.jump = 2.0;
  EXPECT_DOUBLE_EQ(longest_window(flows, {99.0, 9.0}, disks), 2.0 / 5.0);
}

// With fewer than 64 disks each moves proportionally further.
TEST(WindowLength, IsLongerForFewDisks) {
  Scene scene = scene_of_spacing_2();
  scene.box.width = 16.0, scene.box.height = 4.0;  // 16 disks
  EXPECT_DOUBLE_EQ(longest_window(scene, {1.0, 1.0}, 16), 2.0 * 4.0);
}

// An inner wall moves by at most an eighth of the box's shorter side, with disks and without.
TEST(WindowLength, KeepsInnerWallsNear) {
  Scene scene = scene_of_spacing_2();
  InnerWall wall;
  wall.motion.pace = {SideMotion::Kind::steady, 0.0, 1.0};
  wall.motion.along = {3.0, 4.0};
  scene.walls = {wall};
  scene.box.inner_walls_move = true;
  EXPECT_DOUBLE_EQ(longest_window(scene, {0.0, 0.0}, 0), 10.0 / (8.0 * 5.0));
  EXPECT_DOUBLE_EQ(longest_window(scene, {0.0, 0.0}, disks), 10.0 / (8.0 * 5.0));
  // If that allows a longer window, the wall's speed counts as the speed that it gives to disks at rest.
  scene.box.width = scene.box.height = 200.0;
  EXPECT_DOUBLE_EQ(longest_window(scene, {0.0, 0.0}, 10000), 2.0 / 5.0);
}

// Windows aim at two events per disk, and at least 32; they are halved or doubled at most. Without an event the length
// is doubled, unless the window was cut short.
TEST(NextWindow, AimsAtTwoEventsADisk) {
  EXPECT_DOUBLE_EQ(next_window(1.0, 1.0, 200, disks), 1.0);
  EXPECT_DOUBLE_EQ(next_window(1.0, 1.0, 160, disks), 1.25);
  EXPECT_DOUBLE_EQ(next_window(1.0, 0.5, 100, disks), 1.0);
  EXPECT_DOUBLE_EQ(next_window(1.0, 1.0, 32, 4), 1.0);
  EXPECT_EQ(next_window(1.0, 1.0, 1, disks), 2.0);
  EXPECT_EQ(next_window(1.0, 1.0, 100000, disks), 0.5);
  EXPECT_EQ(next_window(1.0, 1.0, 0, disks), 2.0);
  EXPECT_EQ(next_window(1.0, 0.5, 0, disks), 1.0);
}

// A window is between 1 / 512 of the longest one and the whole; the first is 1 / 32 of it. A length below that bound
// (state.window < 0, in a crowded box) is used as it is.
TEST(ClampedWindow, IsAShareOfTheLongest) {
  EXPECT_EQ(clamped_window(0.0, 64.0), 2.0);
  EXPECT_EQ(clamped_window(HUGE_VAL, 64.0), 2.0);
  EXPECT_EQ(clamped_window(5.0, 64.0), 5.0);
  EXPECT_EQ(clamped_window(500.0, 64.0), 64.0);
  EXPECT_EQ(clamped_window(1e-3, 64.0), 0.125);
  EXPECT_EQ(clamped_window(-1e-3, 64.0), 1e-3);
  EXPECT_EQ(clamped_window(-100.0, 64.0), 64.0);
  EXPECT_EQ(clamped_window(5.0, HUGE_VAL), HUGE_VAL);
}

// 32 paths per disk, but at least 65536.
TEST(MostPaths, IsAShareOfEachDisk) {
  EXPECT_EQ(most_paths(10), 65536U);
  EXPECT_EQ(most_paths(10000), 320000U);
}

// Speeds are relative to the flow, except the largest, from which the exact method bounds the reach of disks.
TEST(SpeedTally, IsOfMotionRelativeToTheFlow) {
  Domain box = test::box_of(40.0, 10.0, test::Periodic::both);
  Disks d = test::disks_of({{5.0, 7.0, 3.0, 4.0, 0.5, 1.0}, {9.0, 5.0, 0.0, 1.0, 0.5, 1.0}});
  for (const bool flows : {false, true}) {
    if (flows) box.shear.rate = 1.5;  // 3 at y = 7, 0 at y = 5
    SpeedTally tally;
    tally.add(d, box, 0, 2);
    const SpeedSummary speeds = summarise_speeds(tally, 2);
    EXPECT_EQ(speeds.largest2, 25.0);
    EXPECT_EQ(speeds.mean2, flows ? 8.5 : 13.0);
  }
}

}  // namespace
}  // namespace carom
