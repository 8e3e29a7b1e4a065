// Regions in which groups start, drift, distributions of sizes, and the messages for impossible ones.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/disks/state_hash.hpp"
#include "core/measure/invariants.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/circle_lattice.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/motion_of_group.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using testing::HasSubstr;
using testing::StartsWith;

std::string scene_with(const std::string& disks, const std::string& sides = "") {
  return "seed = 5\n[box]\nwidth = 40.0\nheight = 30.0\n" + sides + disks + "[run]\nt_end = 1.0\n";
}

std::string group(int count, const std::string& positions, const std::string& more) {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"{}\"\nradius = 0.5\nmass = 2.0\n{}", count, positions, more);
}

constexpr const char* all_periodic =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

// The start of a scene, which must have the same bits from one thread and from three, no overlap, and no disk beyond a
// side.
Disks start_of(const std::string& text) {
  const Scene scene = scene_from(text);
  const State state = initial_state(scene);
  EXPECT_EQ(state_hash(parallel_initial_state(scene, 3).disks), state_hash(state.disks));
  EXPECT_LT(max_overlap(state.disks, scene.box), 1e-12);
  EXPECT_LT(wall_overlap(state.disks, scene.box), 1e-12);
  return state.disks;
}

void expect_in_rectangle(const Disks& d, std::size_t first, std::size_t last, Vec2 low, Vec2 high) {
  for (std::size_t i = first; i < last; ++i) {
    const double r = d.radius_of(i) * (1.0 - 1e-12);
    EXPECT_TRUE(d.x[i] >= low.x + r && d.x[i] <= high.x - r && d.y[i] >= low.y + r && d.y[i] <= high.y - r) << i;
  }
}

void expect_in_circle(const Disks& d, std::size_t first, std::size_t last, Vec2 centre, double radius) {
  for (std::size_t i = first; i < last; ++i) {
    EXPECT_LE(std::hypot(d.x[i] - centre.x, d.y[i] - centre.y), (radius - d.radius_of(i)) * (1.0 + 1e-9)) << i;
  }
}

TEST(StartRegion, RandomDisksFillTheirOwnAsDenselyAsABox) {
  // A packing fraction of 0.47 within each region needs the search of the last free places; the rest of the box is
  // empty.
  const Disks d =
      start_of(scene_with(group(60, "random", "region = [2.0, 3.0, 12.0, 13.0]\n") +
                          group(60, "random", "region = { circle = [28.0, 20.0, 5.65] }\n") + group(30, "random", "")));
  expect_in_rectangle(d, 0, 60, {2.0, 3.0}, {12.0, 13.0});
  expect_in_circle(d, 60, 120, {28.0, 20.0}, 5.65);
  expect_in_rectangle(d, 120, 150, {0.0, 0.0}, {40.0, 30.0});
}

TEST(StartRegion, PlacesAreUniformOverIt) {
  // The disks are so small that overlap hardly matters: the mean square distance of centres from the middle is that of
  // a uniform disk, R^2 / 2.
  std::string text = scene_with(group(4000, "random", "region = { circle = [20.0, 15.0, 12.0] }\n"));
  text = replaced(text, "radius = 0.5", "radius = 0.001");
  const Disks d = start_of(text);
  double squares = 0.0, x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    squares += (d.x[i] - 20.0) * (d.x[i] - 20.0) + (d.y[i] - 15.0) * (d.y[i] - 15.0);
    x += d.x[i] - 20.0;
    y += d.y[i] - 15.0;
  }
  // The mean of 4000 such squares has a standard deviation of R^2 / sqrt(12 * 4000); the tolerance is four times that.
  EXPECT_NEAR(squares / 4000.0, 72.0, 4.0 * 144.0 / std::sqrt(48000.0));
  EXPECT_NEAR(x / 4000.0, 0.0, 4.0 * 6.0 / std::sqrt(4000.0));
  EXPECT_NEAR(y / 4000.0, 0.0, 4.0 * 6.0 / std::sqrt(4000.0));
}

// Sides that stand inside the box do not shift regions: a circle is where the scene puts it.
TEST(StartRegion, ACircleStaysWhereItIsBetweenSidesThatMove) {
  const std::string sides =
      "left = { motion = { velocity = [0.1, 0.0] }, place = 6.0 }\n"
      "bottom = { motion = { velocity = [0.0, 0.1] }, place = 4.0 }\n";
  for (const char* positions : {"random", "hexagonal"}) {
    const Disks d = start_of(scene_with(group(8, positions, "region = { circle = [12.0, 14.0, 3.0] }\n"), sides));
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_LE(std::hypot(d.x[i] - 12.0, d.y[i] - 14.0), 2.5 + 1e-6) << positions << " " << i;
    }
  }
}

// The same for obstacles: a fixed disk and the ends of a wall are where the scene puts them.
TEST(StartRegion, ObstaclesStayWhereTheyAreBetweenSidesThatMove) {
  const Scene scene = scene_from(
      scene_with("[[disks]]\nfixed = true\ncount = 2\npositions = [[20.0, 15.0], [30.0, 9.0]]\nradius = 2.0\n" +
                     group(20, "random", "") + "[[walls]]\nfrom = [12.0, 10.0]\nto = [14.0, 20.0]\n",
                 "left = { motion = { velocity = [0.1, 0.0] }, place = 6.0 }\n"
                 "top = { motion = { velocity = [0.0, -0.1] }, place = 27.0 }\n"
                 "bottom = { motion = { velocity = [0.0, 0.1] }, place = 4.0 }\n"));
  const std::vector<Obstacle> all = initial_state(scene).obstacles;
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ((Vec2{all[0].x, all[0].y}), (Vec2{20.0, 15.0}));
  EXPECT_EQ((Vec2{all[1].x, all[1].y}), (Vec2{30.0, 9.0}));
  EXPECT_EQ((Vec2{all[2].x, all[2].y}), (Vec2{12.0, 10.0}));
  EXPECT_EQ((Vec2{all[2].dx, all[2].dy}), (Vec2{2.0, 10.0}));
}

// A rectangle may touch a moving side at its place at time 0, but reach beyond none of the four.
TEST(StartRegion, NoneReachesBeyondASideThatMoves) {
  const auto said = [](const std::string& region) {
    return complaint(scene_with(group(4, "random", "region = " + region + "\n"),
                                "left = { motion = { velocity = [0.1, 0.0] }, place = 6.0 }\n"
                                "right = { motion = { velocity = [-0.1, 0.0] }, place = 35.0 }\n"
                                "bottom = { motion = { velocity = [0.0, 0.1] }, place = 4.0 }\n"
                                "top = { motion = { velocity = [0.0, -0.1] }, place = 27.0 }\n"));
  };
  EXPECT_EQ(said("[6.0, 4.0, 35.0, 27.0]"), "");
  for (const char* region : {"[5.9, 4.0, 35.0, 27.0]", "[6.0, 3.9, 35.0, 27.0]", "[6.0, 4.0, 35.1, 27.0]",
                             "[6.0, 4.0, 35.0, 27.1]", "{ circle = [20.0, 20.0, 7.1] }"}) {
    EXPECT_THAT(said(region), HasSubstr("disks.0.region: reaches beyond a moving side")) << region;
  }
}

// Sides that vibrate against each other come to 10.5 - (2 + 3) - |2 + 3| of each other; in phase they do not.
TEST(StartRegion, SidesThatVibrateTogetherAreAsFarApartAsTheyComeNear) {
  const auto scene = [](const char* right) {
    return replaced(
        scene_with(group(1, "random", ""),
                   std::string("left = { motion = { vibrate = [2.0, 0.0], period = 1.0 } }\nright = { motion = "
                               "{ vibrate = [") +
                       right + ", 0.0], period = 1.0 } }\n"),
        "width = 40.0", "width = 10.5");
  };
  EXPECT_THAT(complaint(scene("-3.0")), HasSubstr("brings the left and right sides within 0.5 of each other"));
  EXPECT_THAT(complaint(scene("3.0")), testing::Not(HasSubstr("brings the left and right")));
}

TEST(StartRegion, ALatticeFillsARectangleAndMayTouchItsEdges) {
  const std::string region = "region = [20.0, 10.0, 30.0, 15.0]\n";
  const Disks d = start_of(scene_with(group(50, "square", region)));
  expect_in_rectangle(d, 0, 50, {20.0, 10.0}, {30.0, 15.0});
  EXPECT_EQ((Vec2{d.x[0], d.y[0]}), (Vec2{20.5, 10.5})) << "ten by five disks of diameter 1";
  expect_in_rectangle(start_of(scene_with(group(45, "hexagonal", region))), 0, 45, {20.0, 10.0}, {30.0, 15.0});
}

TEST(StartRegion, ItHasNoEdgeWhereItSpansAPeriodicSide) {
  const Disks d = start_of(scene_with(group(400, "square", "region = [0.0, 0.0, 40.0, 10.0]\n") +
                                          group(300, "random", "region = [0.0, 10.0, 40.0, 30.0]\n"),
                                      all_periodic));
  // Along the other axis the region has edges: rows of forty disks, 1 + floor((10 - 1) / (sqrt(3) / 2)) of them.
  const Disks rows = start_of(scene_with(group(440, "hexagonal", "region = [0.0, 10.0, 40.0, 20.0]\n"), all_periodic));
  const auto [low, high] = std::minmax_element(rows.y.begin(), rows.y.end());
  EXPECT_GE(*low, 10.5 - 1e-12);
  EXPECT_LE(*high, 19.5 + 1e-12);
  double least = 1.0;
  for (std::size_t i = 400; i < 700; ++i) least = std::min(least, d.x[i]);
  EXPECT_LT(least, 0.5) << "random disks must lie across the side, too";
  // A region that is the whole box must be the same as no region.
  const std::string all = scene_with(group(300, "random", "region = [0.0, 0.0, 40.0, 30.0]\n"), all_periodic);
  EXPECT_EQ(state_hash(start_of(all)), state_hash(start_of(replaced(all, "region = [0.0, 0.0, 40.0, 30.0]\n", ""))));
}

// A few disks must be found quickly in a circle where a lattice of touching disks would have thousands of millions of
// sites.
TEST(CircleLattice, FewDisksInALargeCircleAreFoundAtOnce) {
  constexpr double reach = 1e9;
  for (const bool hexagonal : {false, true}) {
    const std::vector<Vec2> one = circle_sites({hexagonal, reach, 1.0}, 1);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0], (Vec2{0.0, 0.0}));
    const std::vector<Vec2> seven = circle_sites({hexagonal, reach, 1.0}, 7);
    ASSERT_EQ(seven.size(), 7U);
    for (const Vec2 p : seven) EXPECT_LE(std::hypot(p.x, p.y), reach * (1.0 + 1e-9));
  }
}

TEST(StartRegion, ALatticeInACircleIsCentredAndAsWideAsItCanBe) {
  // Seven touching disks fill a circle of three of their radii.
  const std::vector<Vec2> seven = circle_sites({true, 2.0, 2.0}, 7);
  ASSERT_EQ(seven.size(), 7U);
  EXPECT_EQ(seven[3], (Vec2{0.0, 0.0}));
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_NEAR(std::hypot(seven[k].x, seven[k].y), k == 3 ? 0.0 : 2.0, 1e-11);
  }
  // With more room they are as far apart as possible, and so are five on a square lattice; nine reach sqrt(2) spacings.
  EXPECT_NEAR(circle_sites({true, 3.0, 2.0}, 7).at(0).x, -1.5, 1e-9);
  EXPECT_NEAR(circle_sites({false, 3.0, 2.0}, 5).at(0).y, -3.0, 1e-9);
  EXPECT_NEAR(circle_sites({false, 3.0, 2.0}, 9).at(0).y, -3.0 / std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(circle_sites({true, 2.0, 2.0}, 8).empty());
  EXPECT_EQ(circle_capacity({true, 2.0, 2.0}), 7U);
  EXPECT_EQ(circle_capacity({false, 2.0, 2.0}), 5U);
  EXPECT_EQ(circle_sites({false, 3.0, 1.0}, 1).at(0), (Vec2{0.0, 0.0}));
  for (const char* kind : {"square", "hexagonal"}) {
    for (const int count : {1, 2, 19, 100, 101}) {
      const Disks d = start_of(scene_with(group(count, kind, "region = { circle = [20.0, 15.0, 8.0] }\n")));
      expect_in_circle(d, 0, d.size(), {20.0, 15.0}, 8.0);
    }
  }
}

// By the last bit 2.2 + 1.1 is more than 3.3.
TEST(StartRegion, ACircleMayTouchASideInDecimals) {
  for (const std::string positions : {"random", "square", "hexagonal"}) {
    SCOPED_TRACE(positions);
    const Scene scene =
        scene_from("[box]\nwidth = 3.3\nheight = 3.3\n[[disks]]\ncount = 30\npositions = \"" + positions +
                   "\"\nregion = { circle = [2.2, 1.65, 1.1] }\nradius = 0.05\nmass = 1.0\n[run]\nt_end = 1.0\n");
    const Disks disks = initial_state(scene).disks;
    EXPECT_LE(*std::max_element(disks.x.begin(), disks.x.end()), 3.25 + 1e-12);
  }
}

// By the last bit 0.1 + 0.2 is more than 0.3, and 0.9 - 0.3 + 0.3 more than 0.9.
TEST(StartRegion, OneDiskMayFillACircleInDecimals) {
  for (const char* positions : {"random", "square", "hexagonal"}) {
    for (const char* radius : {"0.3", "0.30000000000000004"}) {
      for (const char* centre : {"1.0", "1.7", "0.9"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", positions, radius, centre));
        const Disks d = start_of(
            replaced(scene_with(group(1, positions, fmt::format("region = {{ circle = [{}, 2.0, 0.3] }}\n", centre))),
                     "radius = 0.5", fmt::format("radius = {}", radius)));
        EXPECT_NEAR(d.x.at(0), std::stod(centre), 1e-12);
        EXPECT_NEAR(d.y.at(0), 2.0, 1e-12);
      }
    }
  }
}

// Far from the corner decimals are rounded by more than 1e-12 of a small radius.
TEST(StartRegion, OneRowMayFillARectangleInDecimals) {
  for (const char* positions : {"random", "square", "hexagonal"}) {
    for (const char* low : {"100000.1", "100000.3", "300000.2", "700000.1"}) {
      SCOPED_TRACE(fmt::format("{} {}", positions, low));
      const std::string region = fmt::format("region = [{}, 1.0, {:.1f}, 1.3]\n", low, std::stod(low) + 0.3);
      const Disks d =
          start_of(replaced(replaced(scene_with(group(1, positions, region)), "width = 40.0", "width = 1e6"),
                            "radius = 0.5", "radius = 0.15"));
      EXPECT_NEAR(d.x.at(0), std::stod(low) + 0.15, 1e-9);
      EXPECT_NEAR(d.y.at(0), 1.15, 1e-12);
    }
  }
}

// The same for three disks in a row, and for two such rows of a hexagonal lattice, three and a half diameters wide.
// They overlap by at most the rounding of decimals there.
TEST(StartRegion, RowsOfSeveralMayFillARectangleInDecimals) {
  const auto far_scene = [](const char* kind, int count, const std::string& bounds) {
    const std::string text = scene_with(group(count, kind, "region = [" + bounds + "]\n"));
    return replaced(replaced(text, "width = 40.0\nheight = 30.0", "width = 1e6\nheight = 1e6"), "radius = 0.5",
                    "radius = 0.15");
  };
  const auto start = [&](const char* kind, int count, const std::string& bounds) {
    const Scene scene = scene_from(far_scene(kind, count, bounds));
    const Disks d = initial_state(scene).disks;
    EXPECT_LT(max_overlap(d, scene.box), 1e-8) << "of their radii";
    return d;
  };
  for (const char* low : {"100000.1", "100000.3", "300000.2", "700000.1"}) {
    SCOPED_TRACE(low);
    const double first = std::stod(low);
    const Disks across = start("square", 3, fmt::format("{}, 1.0, {:.1f}, 1.3", low, first + 0.9));
    const Disks upwards = start("square", 3, fmt::format("1.0, {}, 1.3, {:.1f}", low, first + 0.9));
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = first + 0.15 + 0.3 * static_cast<double>(k);
      EXPECT_NEAR(across.x.at(k), place, 1e-9) << k;
      EXPECT_NEAR(upwards.y.at(k), place, 1e-9) << k;
    }
    const Disks rows = start("hexagonal", 6, fmt::format("{}, 1.0, {:.2f}, 1.6", low, first + 1.05));
    EXPECT_NEAR(rows.x.at(5), first + 0.9, 1e-9);
  }
  EXPECT_THAT(complaint(far_scene("square", 4, "100000.1, 1.0, 100001.0, 1.3")), HasSubstr("expected at most 3"));
}

TEST(StartRegion, BadOnesAreNamedByLineAndKey) {
  const auto region = [](const std::string& kind, const std::string& value) {
    return complaint(scene_with(group(40, kind, "region = " + value + "\n")));
  };
  EXPECT_THAT(region("random", "[2, 3, 1, 9]"),
              StartsWith("gas.toml:10: disks.0.region: its corners are not in order; expected [x0, y0, x1, y1]"));
  EXPECT_THAT(region("random", "[2, 3, 50, 9]"), HasSubstr("reaches out of the box of 40 x 30; expected"));
  EXPECT_THAT(region("random", "{ circle = [5, 5, 5.5] }"), HasSubstr("reaches out of the box of 40 x 30; expected"));
  EXPECT_THAT(region("random", "[2, 3, 2.9, 9]"), HasSubstr("is too small for a disk of radius 0.5; expected"));
  EXPECT_THAT(region("random", "[2, 3, 9]"), HasSubstr("disks.0.region: has 3 numbers; expected [x0, y0, x1, y1], or"));
  EXPECT_THAT(region("random", "\"left\""), HasSubstr("disks.0.region: is a string; expected [x0, y0, x1, y1], or"));
  EXPECT_THAT(region("random", "{ circle = [5, 5] }"), HasSubstr("disks.0.region.circle: has 2 numbers; expected"));
  EXPECT_THAT(region("random", "{ circle = [5, 5, 0] }"), HasSubstr("disks.0.region.circle: has radius 0; expected"));
  EXPECT_THAT(region("random", "{ circl = [5, 5, 3] }"), HasSubstr("disks.0.region.circl: unknown key"));
  EXPECT_THAT(region("growth", "[2, 3, 20, 9]"),
              HasSubstr("disks.0.region: cannot be used with positions = \"growth\"; expected"));
  EXPECT_THAT(complaint(replaced(scene_with(group(1, "random", "region = [2, 3, 20, 9]\n")), "\"random\"", "[[3, 4]]")),
              HasSubstr("disks.0.region: cannot be used with a list of positions; expected"));
  EXPECT_THAT(region("random", "[2, 3, 7, 8]"), HasSubstr("disks.0.positions: \"random\" finds no room for disk"));
  EXPECT_THAT(region("random", "[2, 3, 7, 8]"), HasSubstr("in its region after"));
  // k disks of radius 1/2 in a circle of radius 3 have the packing fraction k / 36.
  const std::string jammed = region("random", "{ circle = [10, 10, 3] }");
  const std::size_t placed = jammed.find("trials; "), fraction = jammed.find("packing fraction ");
  ASSERT_NE(placed, std::string::npos) << jammed;
  ASSERT_NE(fraction, std::string::npos) << jammed;
  EXPECT_NEAR(std::stod(jammed.substr(fraction + 17)), std::stod(jammed.substr(placed + 8)) / 36.0, 1e-4) << jammed;
  EXPECT_THAT(region("square", "[2, 3, 7, 8]"),
              HasSubstr("do not fit on a square lattice in the region of 5 x 5; expected at most 25"));
  EXPECT_THAT(region("hexagonal", "{ circle = [5, 5, 1.5] }"),
              HasSubstr("do not fit on a hexagonal lattice in the circle of radius 1.5; expected at most 7"));
}

TEST(Drift, ComesOnTopOfTheTemperatureOfEachGroup) {
  const Scene scene =
      scene_from(scene_with(group(100, "random", "velocities = { maxwell = 2.0 }\ndrift = [3.0, -1.0]\n") +
                            group(50, "random", "drift = [0.0, 0.25]\n")));
  const State state = initial_state(scene);
  std::vector<std::size_t> first(100), second(50);
  for (std::size_t i = 0; i < 100; ++i) first[i] = i;
  for (std::size_t i = 0; i < 50; ++i) second[i] = 100 + i;
  const GroupMotion hot = test::group_motion(state.disks, first);
  EXPECT_NEAR(hot.velocity.x, 3.0, 1e-12);
  EXPECT_NEAR(hot.velocity.y, -1.0, 1e-12);
  EXPECT_NEAR(hot.temperature, 2.0, 1e-12);
  EXPECT_EQ(test::group_motion(state.disks, second).velocity, (Vec2{0.0, 0.25}));
  EXPECT_EQ(test::group_motion(state.disks, second).temperature, 0.0);
}

TEST(Drift, BadOnesAreNamedByLineAndKey) {
  const auto drift = [](const std::string& value) {
    return complaint(scene_with(group(4, "random", "drift = " + value + "\n")));
  };
  EXPECT_THAT(drift("3.0"), StartsWith("gas.toml:10: disks.0.drift: is a number; expected [vx, vy]"));
  EXPECT_THAT(drift("[1, 2, 3]"), HasSubstr("disks.0.drift: has 3 numbers; expected [vx, vy]"));
  EXPECT_THAT(drift("[1, inf]"), HasSubstr("disks.0.drift"));
  EXPECT_THAT(drift("[0, 1e300]"), HasSubstr("disks.0.drift"));
}

TEST(StartRegion, AResolvedSceneKeepsAllOfIt) {
  const std::string text =
      scene_with(group(7, "random", "region = { circle = [20.0, 15.0, 8.0] }\ndrift = [1.0, 0.5]\nname = \"a\"\n") +
                 replaced(group(9, "square", "region = [1.0, 2.0, 30.0, 29.0]\n"), "radius = 0.5\nmass = 2.0",
                          "radius = { choice = [0.3, 0.4], weights = [1, 3] }\nmass = { lognormal = [2.0, 0.5] }") +
                 replaced(group(5, "random", ""), "radius = 0.5", "radius = { normal = [0.2, 0.01] }"));
  const Scene scene = scene_from(text);
  const std::string resolved = resolved_toml(scene);
  EXPECT_EQ(resolved_toml(scene_from(resolved)), resolved);
  EXPECT_EQ(state_hash(initial_state(scene_from(resolved)).disks), state_hash(initial_state(scene).disks));
}

}  // namespace
}  // namespace carom
