// The legend of a picture describes its content. Words are compared by the ink they take.
#include "io/movie/frame_legend.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/support/picture.hpp"

namespace carom {
namespace {

using test::ink_in;
using test::one_disk;
using test::packed;
using test::pixel;
using test::PixelRange;
using test::shape_in;
using test::square_box;

constexpr int width = 960, height = 926;                             // of a picture of a square box
constexpr int bar_left = width - 98, bar_low = 878, bar_high = 108;  // of the colour bar
constexpr PixelRange count_place{400, width, 44, 68}, time_place{0, 400, 44, 68};

FrameStyle square_style() {
  return {"", square_box(10.0), 1.0, 1};
}

// The painter after a frame without disks, for shape_in.
FramePainter& drawn(FramePainter& painter) {
  painter.paint({}, 0.0);
  return painter;
}

std::uint64_t words_in(const FrameStyle& style, const PixelRange& range) {
  FramePainter painter(style);
  return shape_in(drawn(painter), range);
}

// The shape of these words as the list of groups draws them.
std::uint64_t listed(const std::string& words) {
  FrameStyle style = square_style();
  style.look.colour = ColourBy::group;
  style.groups = 1;
  style.group_names = {words};
  return words_in(style, {width - 84, width, 74, 100});
}

// The words at the lower and the upper end of the colour bar.
constexpr PixelRange low_words{width - 67, width, bar_low - 12, bar_low + 12},
    high_words{width - 67, width, bar_high - 12, bar_high + 12};

TEST(FrameLegend, TheColourBarGoesFromItsLowestValueUp) {
  FrameStyle style = square_style();
  style.low = -2.0;
  style.high = 3.0;
  style.look.colour = ColourBy::radius;
  FramePainter painter(style);
  drawn(painter);
  ASSERT_EQ(painter.width(), width);
  ASSERT_EQ(painter.height(), height);
  const auto near = [](std::uint32_t a, std::uint32_t b) {
    int apart = 0;
    for (const int shift : {0, 8, 16}) {
      apart = std::max(apart, std::abs(static_cast<int>(a >> shift & 0xffU) - static_cast<int>(b >> shift & 0xffU)));
    }
    return apart <= 3;
  };
  for (const double share : {0.001, 0.25, 0.5, 0.999}) {
    const int row = bar_low - static_cast<int>(share * (bar_low - bar_high)) - 1;
    EXPECT_TRUE(near(pixel(painter, bar_left + 10, row), packed(viridis(share)))) << share;
  }
  EXPECT_EQ(shape_in(painter, low_words), listed("-2"));
  EXPECT_EQ(shape_in(painter, high_words), listed("3"));
  EXPECT_EQ(words_in(style, {width - 67, width, 713, 735}), listed("-1")) << "each mark is a fifth of 5";
}

// If disks may lie beyond an end of the scale, that end says so.
TEST(FrameLegend, EndsOfTheScaleSayWhatLiesBeyond) {
  FrameStyle style = square_style();
  style.high = 4.0;
  EXPECT_EQ(words_in(style, low_words), listed("0")) << "no speed is below";
  EXPECT_EQ(words_in(style, high_words), listed("≥ 4")) << "the highest speed is a prediction";
  style.look.colour = ColourBy::mass;
  EXPECT_EQ(words_in(style, high_words), listed("4"));
  style.look.range = {0.0, 4.0};
  EXPECT_EQ(words_in(style, low_words), listed("0")) << "no mass is below";
  EXPECT_EQ(words_in(style, high_words), listed("≥ 4"));
  style.look.range = {1.0, 4.0};
  style.low = 1.0;
  EXPECT_EQ(words_in(style, low_words), listed("≤ 1"));
  EXPECT_EQ(words_in(style, high_words), listed("≥ 4"));
}

// 3 is divided into three and 60 into five: numbers that are short, and the finer of two divisions with equally short
// ones.
TEST(FrameLegend, TheScaleIsCutWhereNumbersAreShort) {
  FrameStyle style = square_style();
  style.look.colour = ColourBy::mass;
  style.high = 3.0;
  EXPECT_EQ(words_in(style, {width - 67, width, 609, 633}), listed("1"));
  style.high = 60.0;
  EXPECT_EQ(words_in(style, {width - 67, width, 712, 736}), listed("12"));
}

TEST(FrameLegend, OneValueIsOneSquareOfItsColour) {
  FrameStyle style = square_style();
  style.look.colour = ColourBy::radius;
  style.low = style.high = 0.5;
  FramePainter painter(style);
  drawn(painter);
  for (const int row : {bar_low - 1, bar_low - 11, bar_low - 22}) {
    EXPECT_EQ(pixel(painter, bar_left + 10, row), packed(viridis(0.5))) << row;
  }
  EXPECT_EQ(pixel(painter, bar_left + 10, bar_low - 24), 0xffffffU);
  EXPECT_EQ(shape_in(painter, {width - 67, width, bar_low - 22, bar_low + 2}), listed("0.5"));
}

TEST(FrameLegend, GroupsHaveTheirNamesOrNumbers) {
  FrameStyle style = square_style();
  style.look.colour = ColourBy::group;
  style.groups = 3;
  style.group_names = {"", "sand"};
  const auto line = [&](int k) { return words_in(style, {width - 84, width, 74 + 26 * k, 98 + 26 * k}); };
  EXPECT_EQ(line(0), listed("group 0"));
  EXPECT_EQ(line(1), listed("sand"));
  EXPECT_EQ(line(2), listed("group 2"));
  EXPECT_EQ(line(3), 0U);
}

// Twenty groups, or as many as there is room for, and then the number of the others, in place of the next square.
TEST(FrameLegend, GroupsThatAreNotListedAreCounted) {
  FrameStyle style = square_style();
  style.look.colour = ColourBy::group;
  FrameStyle low = style;
  low.box.height = 2.0;  // room for 300 pixels: ten squares and a number
  const auto behind_twenty = [&](DiskId groups) {
    style.groups = groups;
    return words_in(style, {width - 108, width, 74 + 26 * 20, 98 + 26 * 20});
  };
  const auto behind_ten = [&](DiskId groups, int lines) {
    low.groups = groups;
    return words_in(low, {1120 - 108, 1120, 74 + 26 * (9 + lines), 98 + 26 * (9 + lines)});
  };
  EXPECT_EQ(behind_twenty(20), 0U);
  EXPECT_NE(behind_twenty(21), 0U);
  EXPECT_EQ(behind_ten(10, 1), 0U);
  EXPECT_EQ(behind_twenty(21), behind_ten(11, 1)) << "and 1 more";
  EXPECT_EQ(behind_twenty(33), behind_ten(23, 1)) << "and 13 more";
  EXPECT_NE(behind_twenty(33), behind_twenty(21));
  EXPECT_EQ(behind_ten(23, 2), 0U);
}

// The kinds of sides are listed in a row below the box; inner walls count.
TEST(FrameLegend, KindsOfSideAreNamedWhereThereAreOthersThanWalls) {
  const PixelRange row{0, width, 898, height};
  const auto word = [](int k) { return PixelRange{28 + 134 * k + 38, 28 + 134 * k + 120, 890, height}; };
  FrameStyle style = square_style();
  EXPECT_EQ(words_in(style, row), 0U);
  style.box.sides = {SideKind::periodic, SideKind::periodic, SideKind::wall, SideKind::sink};
  EXPECT_EQ(words_in(style, word(0)), listed("wall"));
  EXPECT_EQ(words_in(style, word(1)), listed("periodic"));
  EXPECT_EQ(words_in(style, word(2)), listed("sink"));
  style.box.sides.fill(SideKind::periodic);
  EXPECT_EQ(words_in(style, word(0)), listed("periodic"));
  EXPECT_EQ(words_in(style, word(1)), 0U);
  Obstacle& inner = style.obstacles.emplace_back();
  inner.dx = 1.0;
  inner.kind = ObstacleKind::sink;
  EXPECT_EQ(words_in(style, word(1)), listed("sink"));
  inner.kind = ObstacleKind::wall;
  EXPECT_EQ(words_in(style, word(0)), listed("wall"));
  EXPECT_EQ(words_in(style, word(1)), listed("periodic"));
  style.box.sides.fill(SideKind::wall);
  style.obstacles[0].kind = ObstacleKind::sink;
  EXPECT_EQ(words_in(style, word(1)), listed("sink"));
}

// "t = 1.5" on the left; "1 disk" on the right, ending with the box.
TEST(FrameLegend, TimeAndCountAreThoseOfTheFrame) {
  FramePainter painter(square_style());
  std::vector<std::uint64_t> times, counts;
  std::vector<PixelRange> places;
  for (const DiskId disks : {0U, 1U, 2U, 3U}) {
    Disks d;
    for (DiskId id = 0; id < disks; ++id) append(d, {5.0, 5.0, 1.0, 0.0, 1.0, 1.0, id});
    painter.paint(d, 0.5 * disks);
    times.push_back(shape_in(painter, time_place));
    counts.push_back(shape_in(painter, count_place));
    places.push_back(ink_in(painter, count_place));
    EXPECT_LE(places.back().right, width - 132 + 1);
    EXPECT_GE(places.back().right, width - 132 - 4);
  }
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NE(times[k], times[k - 1]);
    EXPECT_NE(counts[k], counts[k - 1]);
  }
  EXPECT_LT(places[1].width(), places[2].width() - 5) << "1 disk is shorter than 2 disks";
  EXPECT_GT(places[0].width(), places[2].width() - 5) << "0 disks";
  painter.paint({}, 1.5);
  const std::uint64_t rounded = shape_in(painter, time_place);
  EXPECT_EQ(rounded, times[3]);
  painter.paint({}, 1.52);
  EXPECT_EQ(shape_in(painter, time_place), rounded) << "one decimal";
  FrameStyle tiny = square_style();
  tiny.time_decimals = -1;
  FramePainter scientific(tiny);
  scientific.paint({}, 1.5e-7);
  const PixelRange ink = ink_in(scientific, time_place);
  scientific.paint({}, 1.5);
  EXPECT_GT(ink.width(), ink_in(scientific, time_place).width() + 30);
}

}  // namespace
}  // namespace carom
