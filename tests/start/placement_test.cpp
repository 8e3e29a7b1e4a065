// Positions of the disks of a scene: no overlap by comparison of all pairs, inside the box, and the densities reached.
#include "core/start/placement.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/start/open_cells.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::Draws;
using test::scene_from;
using testing::HasSubstr;

// Compares all pairs. slack: the share of the sum of radii by which disks may overlap.
void expect_apart(const State& state, const Domain& box, double slack) {
  const Disks& d = state.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    for (std::size_t j = i + 1; j < d.size(); ++j) {
      double dx = d.x[j] - d.x[i];
      double dy = d.y[j] - d.y[i];
      if (box.periodic_x()) dx = nearest_image(dx, box.width);
      if (box.periodic_y()) dy = nearest_image(dy, box.height);
      const double contact = d.radius_of(i) + d.radius_of(j);
      ASSERT_GE(std::sqrt(dx * dx + dy * dy), contact * (1.0 - slack)) << i << " and " << j;
    }
  }
}

void expect_inside(const State& state, const Domain& box) {
  const Disks& d = state.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double rx = box.periodic_x() ? 0.0 : d.radius_of(i);
    const double ry = box.periodic_y() ? 0.0 : d.radius_of(i);
    ASSERT_GE(d.x[i], rx) << i;
    ASSERT_GE(d.y[i], ry) << i;
    ASSERT_LE(d.x[i], box.width - rx) << i;
    ASSERT_LE(d.y[i], box.height - ry) << i;
    if (box.periodic_x()) {
      ASSERT_LT(d.x[i], box.width) << i;
    }
    if (box.periodic_y()) {
      ASSERT_LT(d.y[i], box.height) << i;
    }
  }
}

std::string box_text(std::string_view size, bool periodic_x, bool periodic_y) {
  const char* x = periodic_x ? "periodic" : "wall";
  const char* y = periodic_y ? "periodic" : "sink";
  return fmt::format("[box]\n{}\nleft = \"{}\"\nright = \"{}\"\nbottom = \"{}\"\ntop = \"{}\"\n[run]\nt_end = 1\n",
                     size, x, x, y, y);
}

std::string group(std::string_view positions, std::string_view radius, Count count) {
  return fmt::format("[[disks]]\ncount = {}\npositions = {}\nradius = {}\nmass = 1\n", count, positions, radius);
}

TEST(RandomPlacement, NeitherOverlapsNorLeavesTheBox) {
  Draws draws(41);
  for (int k = 0; k < 60; ++k) {
    const bool px = k % 2 == 0;
    const bool py = k / 2 % 2 == 0;
    const double unit = draws.decades(1e-6, 1e6);
    const std::string wide = fmt::format("{{ uniform = [{:.17g}, {:.17g}] }}", unit, unit * draws.in(1, 6));
    const std::string text =
        fmt::format("seed = {}\n", k) +
        box_text(fmt::format("packing_fraction = {:.17g}\naspect = {:.17g}", draws.in(0.05, 0.4), draws.in(0.6, 1.7)),
                 px, py) +
        group("\"random\"", wide, 100) + group("\"random\"", fmt::format("{:.17g}", unit), 150);
    SCOPED_TRACE(text);
    const Scene scene = scene_from(text);
    const State state = initial_state(scene);
    expect_apart(state, scene.box, 0.0);
    expect_inside(state, scene.box);
  }
}

TEST(RandomPlacement, ReachesHighDensitiesByOpenCells) {
  for (const bool periodic : {true, false}) {
    // Centres keep away from walls, so the same fraction is harder to reach between walls.
    const double fraction = periodic ? 0.53 : 0.51;
    const Scene scene = scene_from(box_text(fmt::format("packing_fraction = {}", fraction), periodic, periodic) +
                                   group("\"random\"", "0.5", 2000));
    const State state = initial_state(scene);
    expect_apart(state, scene.box, 0.0);
    expect_inside(state, scene.box);
  }
}

TEST(RandomPlacement, SaysWhenTheDensityCannotBeReached) {
  for (const Count count : {5U, 50U, 3000U}) {
    const std::string message =
        test::complaint(box_text("packing_fraction = 0.7", true, true) + group("\"random\"", "0.5", count));
    EXPECT_THAT(message, HasSubstr("\"random\" finds no room for disk")) << count;
    EXPECT_THAT(message, HasSubstr("packing fraction 0.")) << count;
  }
}

// Random sequential addition jams at 0.547 (Feder 1980), here with a finite number of trials.
TEST(RandomPlacement, JamsWhereItShould) {
  const std::string message =
      test::complaint(box_text("packing_fraction = 0.6", true, true) + group("\"random\"", "0.5", 4000));
  const std::size_t at = message.find("packing fraction ");
  ASSERT_NE(at, std::string::npos) << message;
  EXPECT_NEAR(std::stod(message.substr(at + 17)), 0.5440, 0.0045) << message;
}

TEST(RandomPlacement, FillsTheRoomUniformly) {
  const Scene scene =
      scene_from(box_text("width = 1000\nheight = 1000", false, true) + group("\"random\"", "0.01", 40000));
  const State state = initial_state(scene);
  std::array<int, 16> counts{};
  for (std::size_t i = 0; i < state.disks.size(); ++i) {
    const auto column = static_cast<std::size_t>(state.disks.x[i] / 250.0);
    const auto row = static_cast<std::size_t>(state.disks.y[i] / 250.0);
    ++counts[4 * row + column];
  }
  double chi_squared = 0.0;
  for (const int c : counts) chi_squared += (c - 2500.0) * (c - 2500.0) / 2500.0;
  EXPECT_LT(chi_squared, 37.7) << "15 degrees of freedom, 0.1 %";
}

TEST(RandomPlacement, AvoidsDisksOfOtherGroups) {
  Draws draws(42);
  for (int k = 0; k < 20; ++k) {
    const bool periodic = k % 2 == 0;
    const std::string text = fmt::format("seed = {}\n", draws.bits() >> 1) +
                             box_text("width = 40\nheight = 30", periodic, periodic) +
                             group("\"random\"", "{ uniform = [0.1, 1.5] }", 60) +
                             group("[[20, 15], [5, 5], [30, 7]]", "[3, 2, 0.5]", 3) + group("\"random\"", "0.2", 200);
    SCOPED_TRACE(text);
    const Scene scene = scene_from(text);
    const State state = initial_state(scene);
    EXPECT_EQ(state.disks.x[60], 20.0) << "ids follow the order of the file, whichever group is placed first";
    expect_apart(state, scene.box, 0.0);
    expect_inside(state, scene.box);
  }
}

// Places that the search found closed for large disks may be open for small ones: near the jamming of the large disks,
// at 0.53, there is room for many small ones.
TEST(RandomPlacement, SmallDisksFindRoomWhereLargeOnesFindNone) {
  const Scene scene = scene_from(box_text("width = 15.4\nheight = 15.4", true, true) + group("\"random\"", "0.5", 160) +
                                 group("\"random\"", "0.05", 960));
  const State state = initial_state(scene);
  expect_apart(state, scene.box, 0.0);
  // The small disks are spread over all of the free space: about half of them are in either half of the box.
  int left = 0;
  for (std::size_t i = 160; i < 1120; ++i) left += state.disks.x[i] < 7.7 ? 1 : 0;
  EXPECT_NEAR(left, 480, 120);
}

// Centres are at least a radius away from every point of an inner wall: 400 disks around two walls that cross.
TEST(RandomPlacement, KeepsClearOfInnerWalls) {
  const Scene scene =
      scene_from(box_text("width = 30\nheight = 30", true, false) + group("\"random\"", "0.5", 400) +
                 "[[walls]]\nfrom = [3, 5]\nto = [27, 25]\n[[walls]]\nfrom = [4, 26]\nto = [26, 4]\nkind "
                 "= \"sink\"\n");
  const State state = initial_state(scene);
  for (std::size_t i = 0; i < state.disks.size(); ++i) {
    for (const auto& [from, to] :
         {std::pair(Vec2{3.0, 5.0}, Vec2{27.0, 25.0}), std::pair(Vec2{4.0, 26.0}, Vec2{26.0, 4.0})}) {
      for (int k = 0; k <= 3000; ++k) {
        const double s = k / 3000.0;
        const Vec2 p{from.x + s * (to.x - from.x), from.y + s * (to.y - from.y)};
        ASSERT_GE(std::hypot(state.disks.x[i] - p.x, state.disks.y[i] - p.y), 0.5) << i;
      }
    }
  }
}

// Fixed disks are placed before the others, wherever the scene lists them, and become obstacles.
TEST(RandomPlacement, KeepsClearOfFixedDisks) {
  const Scene scene = scene_from(box_text("width = 30\nheight = 30", true, false) + group("\"random\"", "0.5", 300) +
                                 "[[disks]]\nfixed = true\ncount = 3\npositions = [[1, 4], [15, 15], [22, 29]]\n"
                                 "radius = [3.0, 6.0, 2.0]\n");
  const State state = initial_state(scene);
  ASSERT_EQ(state.obstacles.size(), 3U);
  for (const Obstacle& o : state.obstacles) {
    for (std::size_t i = 0; i < state.disks.size(); ++i) {
      const double dx = nearest_image(state.disks.x[i] - o.x, scene.box.width);
      ASSERT_GE(std::hypot(dx, state.disks.y[i] - o.y), (o.radius + 0.5) * (1.0 - 1e-15)) << i;
    }
  }
}

TEST(RandomPlacement, OneHugeDiskAmongManySmallOnes) {
  const Scene scene = scene_from(box_text("width = 300\nheight = 300", true, false) + group("\"random\"", "0.3", 3000) +
                                 group("\"random\"", "70", 1));
  const State state = initial_state(scene);
  expect_apart(state, scene.box, 0.0);
  expect_inside(state, scene.box);
}

TEST(LatticePlacement, FitsDenseBoxesWithMixedRadii) {
  for (const std::string_view name : {"\"square\"", "\"hexagonal\""}) {
    for (const double fraction : {0.1, 0.5, 0.7}) {
      const Scene scene =
          scene_from(box_text(fmt::format("packing_fraction = {}", fraction), true, true) + group(name, "0.5", 900));
      const State state = initial_state(scene);
      expect_apart(state, scene.box, 1e-12);
      expect_inside(state, scene.box);
    }
    const Scene mixed = scene_from(box_text("width = 30\nheight = 20", false, false) +
                                   group(name, "{ uniform = [0.1, 0.5] }", 300) + group("\"random\"", "0.05", 300));
    const State state = initial_state(mixed);
    expect_apart(state, mixed.box, 1e-12);
    expect_inside(state, mixed.box);
  }
}

// The largest disk of a group determines the distance of sites, even if it is the last.
TEST(LatticePlacement, HasRoomForTheLargestDisk) {
  for (const char* const positions : {"\"square\"", "\"hexagonal\""}) {
    EXPECT_THAT(
        test::complaint(box_text("width = 6\nheight = 6", false, false) + group(positions, "[0.5, 0.5, 0.5, 2.0]", 4)),
        HasSubstr("4 disks of radius up to 2 do not fit"))
        << positions;
  }
}

TEST(LatticePlacement, HexagonalGoesBeyondRandom) {
  const Scene scene = scene_from(box_text("packing_fraction = 0.88", true, true) + group("\"hexagonal\"", "0.5", 2500));
  expect_apart(initial_state(scene), scene.box, 1e-12);
}

TEST(ListedPlacement, TouchingInDecimalsIsNoOverlap) {
  std::string positions;
  for (int k = 0; k < 50; ++k) positions += fmt::format("[{:.1f}, 0.1], ", 0.1 + 0.2 * k);
  const Scene scene =
      scene_from(box_text("width = 10\nheight = 0.2", false, false) + group(fmt::format("[{}]", positions), "0.1", 50));
  EXPECT_EQ(initial_state(scene).disks.size(), 50U);
  EXPECT_THAT(test::complaint(box_text("width = 10\nheight = 0.2", false, false) +
                              group("[[1, 0.1], [1.1999999, 0.1]]", "0.1", 2)),
              HasSubstr("disks 0 and 1 overlap"));
}

// Far from the corner decimals are rounded by more than 1e-12 of a small radius.
TEST(ListedPlacement, TouchingInDecimalsFarAwayIsNoOverlap) {
  std::string places;
  for (int k = 0; k < 40; ++k) places += fmt::format("[{}.{}, 5], ", 1000000 + k / 5, 2 * (k % 5) + 1);
  EXPECT_EQ(
      test::complaint(box_text("width = 2000000\nheight = 10", false, false) + group("[" + places + "]", "0.1", 40)),
      "");
  EXPECT_THAT(test::complaint(box_text("width = 2000000\nheight = 10", false, false) +
                              group("[[1000000.1, 5], [1000000.29, 5]]", "0.1", 2)),
              HasSubstr("disks 0 and 1 overlap by 0.01"));
}

TEST(ListedPlacement, UpperEndOfAPeriodicAxisIsTheLower) {
  const Scene scene = scene_from(box_text("width = 10\nheight = 8", true, true) + group("[[10, 8]]", "1", 1));
  EXPECT_EQ(initial_state(scene).disks.x[0], 0.0);
  EXPECT_EQ(initial_state(scene).disks.y[0], 0.0);
}

// The first overlap reported is one, and none is missed: compared with all pairs, in lists with many near misses.
TEST(ListedPlacement, EveryOverlapIsFound) {
  Draws draws(43);
  int overlapping = 0;
  for (int k = 0; k < 400; ++k) {
    const bool px = k % 2 == 0;
    const bool py = k / 2 % 2 == 0;
    Domain box;
    box.width = 10;
    box.height = 8;
    test::set_sides(box, px ? SideKind::periodic : SideKind::wall, py ? SideKind::periodic : SideKind::sink);
    std::string positions;
    std::string radii;
    State state;
    for (int i = 0; i < 8; ++i) {
      const double r = draws.decades(0.01, 1.9);
      const double x = px ? draws.in(0, 10) : draws.in(r, 10 - r);
      const double y = py ? draws.in(0, 8) : draws.in(r, 8 - r);
      positions += fmt::format("[{:.17g}, {:.17g}], ", x, y);
      radii += fmt::format("{:.17g}, ", r);
      append(state.disks, {x, y, 0, 0, r, 1, static_cast<DiskId>(i)});
    }
    bool overlap = false;
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = i + 1; j < 8; ++j) {
        double dx = state.disks.x[j] - state.disks.x[i];
        double dy = state.disks.y[j] - state.disks.y[i];
        if (px) dx = nearest_image(dx, 10);
        if (py) dy = nearest_image(dy, 8);
        overlap = overlap || std::sqrt(dx * dx + dy * dy) < state.disks.radius_of(i) + state.disks.radius_of(j);
      }
    }
    const std::string message = test::complaint(box_text("width = 10\nheight = 8", px, py) +
                                                group(fmt::format("[{}]", positions), fmt::format("[{}]", radii), 8));
    EXPECT_EQ(message.find("overlap") != std::string::npos, overlap) << message;
    overlapping += overlap ? 1 : 0;
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 350);
}

// No free point is ever in a closed cell.
TEST(OpenCells, NeverCloseWhatIsFree) {
  Draws draws(44);
  for (int k = 0; k < 40; ++k) {
    Domain box;
    box.width = draws.in(5, 15);
    box.height = draws.in(5, 15);
    test::set_sides(box, k % 2 == 0 ? SideKind::periodic : SideKind::wall,
                    k / 2 % 2 == 0 ? SideKind::periodic : SideKind::wall);
    const double smallest = draws.in(0.05, 0.5);
    OpenCells cells(box, smallest, 200);
    std::vector<Disk> placed;
    for (int i = 0; i < 20; ++i) {
      placed.push_back({draws.in(0, box.width), draws.in(0, box.height), 0, 0, draws.in(smallest, 1.2), 1, 0});
      cells.close_around(placed.back().x, placed.back().y, placed.back().radius);
    }
    int closed = 0;
    for (int i = 0; i < 2000; ++i) {
      const double x = draws.in(0, box.width);
      const double y = draws.in(0, box.height);
      bool free = box.periodic_x() || (x >= smallest && x <= box.width - smallest);
      free = free && (box.periodic_y() || (y >= smallest && y <= box.height - smallest));
      for (const Disk& d : placed) {
        const double dx = box.periodic_x() ? nearest_image(d.x - x, box.width) : d.x - x;
        const double dy = box.periodic_y() ? nearest_image(d.y - y, box.height) : d.y - y;
        free = free && std::sqrt(dx * dx + dy * dy) >= d.radius + smallest;
      }
      if (free) {
        EXPECT_TRUE(cells.is_open(x, y));
      }
      closed += cells.is_open(x, y) ? 0 : 1;
    }
    EXPECT_GT(closed, 100) << "most of the occupied cells must be closed";
  }
}

// Refining the list never loses a free place, and in the end hardly anything else is in it.
TEST(VoxelList, KeepsWhatIsFreeWhenRefined) {
  Draws draws(45);
  for (int k = 0; k < 20; ++k) {
    Domain box;
    box.width = draws.in(6, 9);
    box.height = draws.in(6, 9);
    test::set_sides(box, k % 2 == 0 ? SideKind::periodic : SideKind::wall,
                    k / 2 % 2 == 0 ? SideKind::periodic : SideKind::wall);
    Disks disks;
    disks.common_radius = 0.5;
    disks.common_mass = 1.0;
    for (int i = 0; i < 30; ++i) append(disks, {draws.in(0, box.width), draws.in(0, box.height), 0, 0, 0.5, 1, 0});
    PlacementGrid grid(box, disks);
    OpenCells cells(box, 0.5, disks.size());
    for (std::size_t i = 0; i < disks.size(); ++i) {
      grid.insert(i);
      if (i < 15) cells.close_around(disks.x[i], disks.y[i], 0.5);
    }
    VoxelList list = cells.list();
    const auto free = [&](Vec2 p) {
      return (box.periodic_x() || (p.x >= 0.5 && p.x <= box.width - 0.5)) &&
             (box.periodic_y() || (p.y >= 0.5 && p.y <= box.height - 0.5)) && !grid.overlapping(p.x, p.y, 0.5, false);
    };
    std::vector<Vec2> places;
    for (int i = 0; i < 500; ++i) {
      const Vec2 p{draws.in(0, box.width), draws.in(0, box.height)};
      if (free(p)) places.push_back(p);
    }
    for (int round = 0; round < 5; ++round) {
      list.replace(list.survivors(grid, 0, list.size()));
      for (const Vec2& p : places) EXPECT_TRUE(list.holds(p)) << k << ": " << p.x << ", " << p.y;
    }
    int found = 0;
    for (int i = 0; i < 1000 && !list.empty(); ++i) {
      const Vec2 p = list.point({draws.in(0, 1), draws.in(0, 1)}, draws.in(0, 1));
      found += free({wrap(p.x, box.width), wrap(p.y, box.height)}) ? 1 : 0;
    }
    EXPECT_GT(found, list.empty() ? -1 : 800) << k;
  }
}

}  // namespace
}  // namespace carom
