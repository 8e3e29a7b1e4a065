// In a picture everything is where it is at the frame's time: disks and their images, sides, inner walls.
#include "io/movie/frame.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/movie/frame_legend.hpp"
#include "tests/support/picture.hpp"
#include "tests/support/test_folder.hpp"

namespace carom {
namespace {

using test::ink_in;
using test::one_disk;
using test::packed;
using test::pixel;
using test::PixelRange;
using test::square_box;

constexpr std::uint32_t white = 0xffffffU;
const std::uint32_t grey_wall = packed({51, 51, 51}), orange_sink = packed({213, 94, 0}),
                    grey_obstacle = packed(obstacle_colour);

// The colour at a place in a box of 10 by 10 that is 800 pixels wide, with y upwards.
std::uint32_t colour_at(const FramePainter& painter, double x, double y) {
  return pixel(painter, 28 + static_cast<int>(80.0 * x), 878 - 1 - static_cast<int>(80.0 * y));
}

Domain periodic_box() {
  Domain box = square_box(10.0);
  box.sides.fill(SideKind::periodic);
  return box;
}

TEST(FrameLayout, TheBoxIsInTheMiddleOfWhatTheMarginsLeave) {
  Domain narrow{1.0, 100.0}, low{100.0, 1.0};
  const FrameLayout tall = frame_layout({"", narrow, 1.0, 1});
  EXPECT_EQ(tall.left, 28.0 + 206.0);  // 8 pixels, in the middle of 420
  EXPECT_EQ(tall.bottom, 78.0 + 800.0);
  const FrameLayout flat = frame_layout({"", low, 1.0, 1});
  EXPECT_EQ(flat.left, 28.0);
  EXPECT_EQ(flat.bottom, 78.0 + 155.0);  // 9.6 pixels, in the middle of 300
  FrameStyle given{"", square_box(10.0), 1.0, 1};
  given.look.width = 1280;
  given.look.height = 720;
  const FrameLayout wide = frame_layout(given);
  const double before = wide.left - left_margin * wide.unit;
  const double behind = wide.width - right_margin * wide.unit - (wide.left + 10.0 * wide.scale);
  EXPECT_NEAR(before, behind, 1.1);
  EXPECT_NEAR(wide.bottom, wide.height - bottom_margin * wide.unit, 0.6);
}

// Pictures of a channel of hard rods once showed nothing but its walls.
TEST(Frame, ABoxThinnerThanAPixelShowsItsDisks) {
  for (const SideKind side : {SideKind::wall, SideKind::periodic}) {
    Domain flat{4000.0, 1.0}, tall{1.0, 4000.0};
    flat.sides.fill(side);
    tall.sides.fill(side);
    FramePainter across({"", flat, 1.0, 1}), upwards({"", tall, 1.0, 1});
    across.paint(one_disk(1000.0, 0.5, 1.0, 0.4), 0.0);
    upwards.paint(one_disk(0.5, 1000.0, 1.0, 0.4), 0.0);
    const FrameLayout wide = frame_layout({"", flat, 1.0, 1}), high = frame_layout({"", tall, 1.0, 1});
    const int row = static_cast<int>(wide.bottom) - 1, column = static_cast<int>(high.left);
    const std::uint32_t disk = packed(viridis(1.0));
    EXPECT_EQ(pixel(across, static_cast<int>(wide.left) + 240, row), disk);
    EXPECT_EQ(pixel(across, static_cast<int>(wide.left) + 480, row), white);
    EXPECT_EQ(pixel(upwards, column, static_cast<int>(high.bottom) - 200), disk);
    EXPECT_EQ(pixel(upwards, column, static_cast<int>(high.bottom) - 400), white);
  }
}

// Disks are drawn up to the sides and no further; the lines of the sides are outside.
TEST(Frame, WhatIsInTheBoxReachesToItsSides) {
  FramePainter painter({"", square_box(10.0), 1.0, 1});
  painter.paint(one_disk(5.0, 5.0, 1.0, 20.0), 0.0);
  const std::uint32_t disk = packed(viridis(1.0));
  for (const int k : {0, 400, 799}) {
    EXPECT_EQ(pixel(painter, 28, 78 + k), disk) << k;
    EXPECT_EQ(pixel(painter, 827, 78 + k), disk) << k;
    EXPECT_EQ(pixel(painter, 28 + k, 78), disk) << k;
    EXPECT_EQ(pixel(painter, 28 + k, 877), disk) << k;
    for (const int out : {1, 4}) {
      EXPECT_EQ(pixel(painter, 28 - out, 78 + k), grey_wall) << k;
      EXPECT_EQ(pixel(painter, 827 + out, 78 + k), grey_wall) << k;
      EXPECT_EQ(pixel(painter, 28 + k, 78 - out), grey_wall) << k;
      EXPECT_EQ(pixel(painter, 28 + k, 877 + out), grey_wall) << k;
    }
    EXPECT_EQ(pixel(painter, 28 - 6, 78 + k), white) << k;
    EXPECT_EQ(pixel(painter, 28 + k, 877 + 6), white) << k;
  }
}

TEST(Frame, EachSideIsDrawnAsItsOwnKind) {
  for (const Side sink : all_sides) {
    Domain box = square_box(10.0);
    box.sides[static_cast<std::size_t>(sink)] = SideKind::sink;
    FramePainter painter({"", box, 1.0, 1});
    painter.paint({}, 0.0);
    const std::array<PixelRange, 4> beside{
        {{24, 28, 200, 700}, {828, 832, 200, 700}, {200, 700, 878, 882}, {200, 700, 74, 78}}};
    for (const Side side : all_sides) {
      int orange = 0;
      const PixelRange& range = beside[static_cast<std::size_t>(side)];
      for (int row = range.top; row < range.bottom; ++row) {
        for (int column = range.left; column < range.right; ++column) {
          orange += pixel(painter, column, row) == orange_sink ? 1 : 0;
        }
      }
      EXPECT_EQ(orange > 0, side == sink) << static_cast<int>(side);
    }
  }
}

TEST(Frame, EverySideAndCornerHasItsImages) {
  FramePainter painter({"", periodic_box(), 1.0, 1});
  for (const double x : {0.5, 5.0, 9.5}) {
    for (const double y : {0.5, 5.0, 9.5}) {
      painter.paint(one_disk(x, y, 1.0, 1.0), 0.0);
      for (const double px : {0.1, 5.0, 9.9}) {
        for (const double py : {0.1, 5.0, 9.9}) {
          const Vec2 d = nearest_image({px - x, py - y}, periodic_box());
          EXPECT_EQ(colour_at(painter, px, py) != white, d.x * d.x + d.y * d.y < 1.0)
              << x << " " << y << " at " << px << " " << py;
        }
      }
    }
  }
}

// At time 1 the upper images are displaced by 2.
TEST(Frame, ImagesAcrossTheTopOfAShearedBoxAreDisplaced) {
  Domain box = periodic_box();
  box.shear = {0.2, 2.0, 0.0};
  FramePainter painter({"", box, 1.0, 1});
  painter.paint(one_disk(5.0, 0.2, 1.0, 0.5), 1.0);
  EXPECT_NE(colour_at(painter, 7.0, 9.95), white);
  EXPECT_EQ(colour_at(painter, 3.0, 9.95), white);
  EXPECT_EQ(colour_at(painter, 5.0, 9.95), white);
  painter.paint(one_disk(5.0, 9.8, 1.0, 0.5), 1.0);
  EXPECT_NE(colour_at(painter, 3.0, 0.05), white);
  EXPECT_EQ(colour_at(painter, 7.0, 0.05), white);
  painter.paint(one_disk(7.9, 0.2, 1.0, 0.5), 1.0);  // it has an image across the right side, too
  EXPECT_NE(colour_at(painter, 9.8, 9.95), white);
  EXPECT_NE(colour_at(painter, 0.1, 9.95), white);
  painter.paint(one_disk(8.1, 0.2, 1.0, 0.5), 1.0);
  EXPECT_NE(colour_at(painter, 9.8, 9.95), white);
  EXPECT_NE(colour_at(painter, 0.3, 9.95), white);
}

TEST(Frame, AFewDisksAreSeenHoweverSmall) {
  FramePainter painter({"", square_box(1e5), 1.0, 1});
  painter.paint(one_disk(5e4, 5e4, 1.0, 1.0), 0.0);
  EXPECT_EQ(pixel(painter, 28 + 400, 78 + 400), packed(viridis(1.0)));
  Disks many;
  for (DiskId id = 0; id <= 5000; ++id) append(many, {5e4, 5e4, 1.0, 0.0, 1e-3, 1.0, id});
  painter.paint(many, 0.0);
  EXPECT_EQ(pixel(painter, 28 + 400, 78 + 400), white) << "many small disks show by the area that they cover";
}

TEST(Frame, AGroupOfTheTrajectoryGoesBeforeThatOfTheScene) {
  FrameStyle style{"", square_box(10.0), 1.0, 1};
  style.look.colour = ColourBy::group;
  style.group_ends = {1};
  FramePainter painter(style);
  painter.paint(one_disk(5.0, 5.0, 1.0, 1.0), 0.0);
  EXPECT_EQ(colour_at(painter, 5.0, 5.0), packed(group_colour(0)));
  painter.paint(one_disk(5.0, 5.0, 1.0, 1.0), 0.0, {3});
  EXPECT_EQ(colour_at(painter, 5.0, 5.0), packed(group_colour(3)));
}

TEST(Frame, SidesThatMoveAreWhereTheyAreThen) {
  Domain box = square_box(10.0);
  for (const Side side : all_sides) {
    const auto s = static_cast<std::size_t>(side);
    box.motions[s] = {SideMotion::Kind::steady, 0.5 + 0.25 * static_cast<double>(s), 0.25};
  }
  FramePainter painter({"", box, 1.0, 1});
  for (const double time : {0.0, 1.0, 4.0}) {
    painter.paint({}, time);
    const PixelRange ink = ink_in(painter, {20, 840, 70, 890});
    const int moved = static_cast<int>(20.0 * time);
    EXPECT_EQ(ink.left, 28 + 40 + moved - 4) << time;
    EXPECT_EQ(ink.right, 828 - 60 - moved + 4) << time;
    EXPECT_EQ(ink.bottom, 878 - 80 - moved + 4) << time;
    EXPECT_EQ(ink.top, 78 + 100 + moved - 4) << time;
  }
}

Obstacle segment(Vec2 from, Vec2 to, ObstacleKind kind = ObstacleKind::wall) {
  Obstacle o;
  o.x = from.x;
  o.y = from.y;
  o.dx = to.x - from.x;
  o.dy = to.y - from.y;
  o.kind = kind;
  return o;
}

TEST(Frame, FixedDisksAndInnerWallsAreDrawn) {
  FrameStyle style{"", square_box(10.0), 1.0, 1};
  style.obstacles = {segment({2.0, 2.0}, {4.0, 6.0}), segment({6.0, 2.0}, {6.0, 8.0}, ObstacleKind::sink)};
  Obstacle& disk = style.obstacles.emplace_back();
  disk.x = 8.0;
  disk.y = 7.0;
  disk.radius = 0.5;
  FramePainter painter(style);
  painter.paint({}, 3.0);
  EXPECT_EQ(colour_at(painter, 3.0, 4.0), grey_wall);
  EXPECT_EQ(colour_at(painter, 3.0, 0.5), white);
  EXPECT_EQ(colour_at(painter, 8.0, 7.0), grey_obstacle);
  EXPECT_EQ(colour_at(painter, 8.0, 3.0), white);
  int orange = 0;
  for (int k = 0; k < 400; ++k) orange += pixel(painter, 28 + 480, 300 + k) == orange_sink ? 1 : 0;
  EXPECT_GT(orange, 50);
}

TEST(Frame, InnerWallsThatMoveAreWhereTheyAreThenAndSeenAcrossPeriodicSides) {
  FrameStyle style{"", periodic_box(), 1.0, 1};
  style.box.inner_walls_move = true;
  style.obstacles = {segment({4.0, 5.0}, {6.0, 5.0})};
  style.obstacles[0].moves = true;
  style.wall_motions.resize(1);
  style.wall_motions[0].pace = SideMotion{SideMotion::Kind::steady, 0.0, 1.0};
  style.wall_motions[0].along = {2.25, 0.5};
  FramePainter painter(style);
  painter.paint({}, 0.0);
  EXPECT_EQ(colour_at(painter, 5.0, 5.0), grey_wall);
  painter.paint({}, 1.0);
  EXPECT_EQ(colour_at(painter, 7.25, 5.5), grey_wall);
  EXPECT_EQ(colour_at(painter, 5.0, 5.0), white);
  painter.paint({}, 2.0);  // it reaches from 8.5 to 10.5
  EXPECT_EQ(colour_at(painter, 9.0, 6.0), grey_wall);
  EXPECT_EQ(colour_at(painter, 0.25, 6.0), grey_wall);
  EXPECT_EQ(colour_at(painter, 1.0, 6.0), white);
  style.wall_motions[0].along = {0.0, 1.0};
  style.obstacles = {segment({5.0, 4.0}, {5.0, 6.0})};
  style.obstacles[0].moves = true;
  FramePainter upwards(style);
  for (const double time : {4.5, 14.5}) {
    upwards.paint({}, time);
    EXPECT_EQ(colour_at(upwards, 5.0, 9.0), grey_wall) << time;
    EXPECT_EQ(colour_at(upwards, 5.0, 0.25), grey_wall) << time;
    EXPECT_EQ(colour_at(upwards, 5.0, 1.0), white) << time;
  }
  style.wall_motions[0].along = {1.0, 1.0};
  style.obstacles = {segment({6.0, 5.0}, {4.0, 5.0})};  // the same wall with its ends exchanged
  style.obstacles[0].moves = true;
  FramePainter backwards(style);
  backwards.paint({}, 4.75);  // it reaches from 10.75, which is 0.75, to 8.75
  EXPECT_EQ(colour_at(backwards, 0.5, 9.75), grey_wall);
  EXPECT_EQ(colour_at(backwards, 9.5, 9.75), grey_wall);
  EXPECT_EQ(colour_at(backwards, 5.0, 9.75), white);
  style.obstacles = {segment({5.0, 6.0}, {5.0, 4.0})};
  style.obstacles[0].moves = true;
  FramePainter downwards(style);
  downwards.paint({}, 4.75);
  EXPECT_EQ(colour_at(downwards, 9.75, 0.5), grey_wall);
  EXPECT_EQ(colour_at(downwards, 9.75, 9.5), grey_wall);
  EXPECT_EQ(colour_at(downwards, 9.75, 5.0), white);
}

// The same as vector graphics: parts beyond a side are cut off, and a large disk is a rim with the inner part on it.
TEST(Frame, ASvgShowsTheSame) {
  const test::TestFolder folder("frame_svg");
  const std::string path = (folder.path() / "frame.svg").string();
  const auto svg_of = [&](const Disks& disks, double time) {
    FrameStyle style{"", square_box(10.0), 1.0, 1};
    style.obstacles = {segment({2.0, 2.0}, {4.0, 6.0})};
    style.box.motions[0] = SideMotion{SideMotion::Kind::steady, 0.0, 0.5};
    style.look.colour = ColourBy::group;
    FramePainter(style).write_svg(path, disks, time, disks.empty() ? std::vector<DiskId>{} : std::vector<DiskId>{5});
    return test::text_of(path);
  };
  const auto parts = [](const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  };
  const std::string none = svg_of({}, 0.0), one = svg_of(one_disk(5.0, 5.0, 1.0, 1.0), 0.0);
  // Sky blue for group 5, and 0.35 of it for the rim.
  EXPECT_THAT(one, ::testing::ContainsRegex("rgb\\(33.725[0-9]*%, ?70.588[0-9]*%, ?91.372[0-9]*%\\)"));
  EXPECT_THAT(one, ::testing::ContainsRegex("rgb\\(11.803[0-9]*%, ?24.705[0-9]*%, ?31.980[0-9]*%\\)"));
  // A circle of 80 pixels for the rim, and one of 79 on it.
  EXPECT_EQ(parts(one, "M 508 478 "), 1U);
  EXPECT_EQ(parts(one, "M 507 478 "), 1U);
  EXPECT_EQ(parts(one, "stroke-width"), 5U) << "four sides and a wall";
  EXPECT_EQ(parts(none, "stroke-width"), 5U);
  EXPECT_EQ(parts(one, "clip"), 0U);
  EXPECT_GT(parts(svg_of(one_disk(5.0, 10.0, 1.0, 1.0), 0.0), "clip"), 0U) << "half of it is outside";
  EXPECT_NE(none, svg_of({}, 0.1)) << "the time differs";
  EXPECT_GT(parts(none, "<use"), 8U) << "the letters of the time and the count";
}

TEST(Frame, ASvgThatCannotBeWrittenIsAnError) {
  const FramePainter painter({"", square_box(10.0), 1.0, 1});
  EXPECT_ANY_THROW(painter.write_svg("/dev/full", one_disk(5.0, 5.0, 1.0, 1.0), 0.0));
  EXPECT_ANY_THROW(painter.write_svg("/nonexistent/frame.svg", {}, 0.0));
  EXPECT_ANY_THROW(painter.write_png("/nonexistent/frame.png"));
}

}  // namespace
}  // namespace carom
