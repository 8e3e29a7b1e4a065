// Growth of initial states: no overlap to the last bit, the radii wanted, the same bits from both ways and at any
// scale, and a clear message if the disks jam.
#include "core/start/growth.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "core/disks/disks.hpp"
#include "core/disks/domain.hpp"
#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state_hash.hpp"
#include "core/physics/obstacle_contact.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/start/growth_flights.hpp"
#include "parallel/start/growth_step.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::scene_from;
using testing::HasSubstr;

constexpr const char* periodic =
    "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

std::string text_of(std::string_view box, std::string_view disks, std::string_view more = "") {
  return fmt::format("seed = 11\n[box]\n{}\n{}\n{}\n[run]\nt_end = 1\n", box, disks, more);
}

std::string group(int count, std::string_view radius) {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"growth\"\nradius = {}\nmass = 1\n", count, radius);
}

// All disks are inside, and none is closer to another than contact, by the arithmetic of the contact test itself.
void expect_free(const State& state, const Domain& box) {
  const Disks& d = state.disks;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const double r = d.radius_of(i);
    if (!box.periodic_x()) {
      EXPECT_GE(d.x[i], r);
      EXPECT_LE(d.x[i], box.width - r);
    }
    if (!box.periodic_y()) {
      EXPECT_GE(d.y[i], r);
      EXPECT_LE(d.y[i], box.height - r);
    }
    for (std::size_t j = i + 1; j < d.size(); ++j) {
      double dx = d.x[j] - d.x[i];
      double dy = d.y[j] - d.y[i];
      if (box.periodic_x()) dx = nearest_image(dx, box.width);
      if (box.periodic_y()) dy = nearest_image(dy, box.height);
      const double contact = r + d.radius_of(j);
      EXPECT_GE(dx * dx + dy * dy, contact * contact) << i << " " << j;
    }
  }
}

struct Case {
  const char* name;
  std::string box, disks;
};

// Mixtures, two groups, equal disks, a huge disk among small ones; walls, sinks, periodic sides; very few disks.
std::vector<Case> cases() {
  const std::string torus = periodic;
  return {{"mixed", torus + "packing_fraction = 0.8", group(120, "{ uniform = [1, 5] }")},
          {"two_groups", torus + "packing_fraction = 0.78\naspect = 2", group(60, "1") + group(60, "1.4")},
          {"walls", "packing_fraction = 0.72", group(100, "{ uniform = [1, 5] }")},
          {"sinks", "left = \"sink\"\nright = \"sink\"\npacking_fraction = 0.7", group(100, "{ uniform = [1, 2] }")},
          {"equal", torus + "packing_fraction = 0.72", group(120, "0.3")},
          {"huge", torus + "packing_fraction = 0.7", group(1, "5") + group(300, "0.7")},
          {"loose", torus + "packing_fraction = 0.2", group(50, "1")},
          {"one", "width = 2.5\nheight = 2.5", group(1, "1")},
          {"two", "width = 2.2\nheight = 4.4", group(2, "1")}};
}

TEST(Growth, PlacesWithoutOverlapToTheLastBit) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = scene_from(text_of(c.box, c.disks));
    const State state = parallel_initial_state(scene, 2);
    expect_free(state, scene.box);
    std::vector<double> radii;
    std::vector<double> masses;
    DiskId first = 0;
    for (const DiskGroup& g : scene.groups) {
      draw_sizes(scene, g, first, radii, masses);
      for (std::size_t k = 0; k < g.count; ++k) EXPECT_EQ(state.disks.radius_of(first + k), radii[k]);
      first += static_cast<DiskId>(g.count);
    }
  }
}

State grown(const Scene& scene, int threads, std::size_t divisor) {
  const Executor executor(threads, divisor);
  return initial_state(scene, place_at_random, parallel_growth(executor, {threads, divisor}));
}

TEST(LongGrowth, SameBitsPlainAndParallel) {
  for (const Case& c : cases()) {
    const Scene scene = scene_from(text_of(c.box, c.disks));
    const State expected = initial_state(scene);
    const bool all = c.name == std::string("walls");  // all numbers of threads in one case only, to save time
    for (const int threads : all ? std::vector{1, 2, 3, 8} : std::vector{2}) {
      const State state = grown(scene, threads, threads == 1 ? 1 : 300);
      EXPECT_EQ(state.disks.x, expected.disks.x) << c.name << ", " << threads;
      EXPECT_EQ(state.disks.y, expected.disks.y) << c.name << ", " << threads;
    }
  }
}

// Fixed disks that overlap each other and reach out of the box, a fixed disk that is placed at random, a polyline, a
// sink; denser than random addition can reach.
std::vector<Case> obstructed_cases() {
  const std::string pegs =
      "[[disks]]\nfixed = true\ncount = 5\npositions = [[0.5, 9.0], [20.0, 20.0], [22.0, 21.0], [12.0, 30.0], [33.0, "
      "8.0]]\nradius = [2.0, 3.0, 2.5, 1.0, 4.0]\n"
      "[[disks]]\nfixed = true\ncount = 1\npositions = \"random\"\nradius = 1.5\n";
  const std::string walls =
      "[[walls]]\npoints = [[5.0, 5.0], [14.0, 9.0], [11.0, 16.0]]\n"
      "[[walls]]\nfrom = [24.0, 30.0]\nto = [38.0, 30.0]\nkind = \"sink\"\n";
  const std::string box = "width = 40\nheight = 36";
  return {{"pegs", std::string(periodic) + box, group(118, "{ uniform = [1, 2] }") + pegs},
          {"pegs_first", box, pegs + group(340, "{ uniform = [0.5, 1.2] }")},
          {"walls", box, group(115, "{ uniform = [1, 2] }") + walls},
          {"both", std::string(periodic) + box, pegs + group(50, "1.7") + group(98, "1.0") + walls},
          {"beside_a_piston", "left = { place = 3, motion = { velocity = [-1, 0] } }\n" + box,
           group(103, "{ uniform = [1, 2] }") + test::replaced(pegs, "[0.5, 9.0]", "[7.5, 9.0]") + walls}};
}

TEST(LongGrowth, KeepsClearOfObstaclesToTheLastBit) {
  for (const Case& c : obstructed_cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = scene_from(text_of(c.box, c.disks));
    const State state = initial_state(scene);
    expect_free(state, scene.box);
    Domain box = scene.box;
    const auto cells = place_obstacles(state.obstacles, box);
    const Disks& d = state.disks;
    double area = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      area += 3.14159 * d.radius_of(i) * d.radius_of(i);
      for (const Obstacle& o : state.obstacles) {
        if (!scene.box.has_moving_side()) {
          EXPECT_LE(gap_to(o, d.x[i], d.y[i], d.radius_of(i), box).beyond, 0.0) << i;
        } else {  // whose coordinates are shifted by the side's place
          EXPECT_LE(gap_to(o, d.x[i], d.y[i], d.radius_of(i), box).beyond, 1e-12) << i;
        }
      }
    }
    EXPECT_GT(area / (box.width * box.height), 0.5);
    for (const int threads : {1, 2, 5}) {
      const State other = grown(scene, threads, 300);
      EXPECT_EQ(other.disks.x, d.x) << threads;
      EXPECT_EQ(other.disks.y, d.y) << threads;
      EXPECT_EQ(other.disks.id, d.id) << threads;
      EXPECT_EQ(other.obstacles.size(), state.obstacles.size());
    }
  }
}

// A disk beside a peg grows by three quarters of the whole gap, as the peg does not grow; the same at a wall.
TEST(Growth, StepTakesTheGapsToObstacles) {
  Domain box;
  box.width = box.height = 40.0;
  const std::vector<Obstacle> obstacles{{10.0, 10.0, 0.0, 0.0, 2.0, 1.0, 7, ObstacleKind::disk},
                                        {30.0, 0.0, 0.0, 40.0, 0.0, 1.0, 0, ObstacleKind::wall}};
  const auto cells = place_obstacles(obstacles, box);
  Disks d;
  d.x = {15.0, 27.0, 5.0};
  d.y = {10.0, 25.0, 34.0};
  d.vx = d.vy = {0.0, 0.0, 0.0};
  d.radius = {1.0, 2.0, 1.0};
  d.id = {0, 1, 2};
  const GrowthTally tally = grow_step(d, box, {9.0, 9.0, 1.5});
  EXPECT_DOUBLE_EQ(d.radius[0], 1.0 + 0.75 * 2.0);
  EXPECT_DOUBLE_EQ(d.radius[1], 2.0 + 0.75 * 1.0);
  EXPECT_EQ(d.radius[2], 1.5);
  EXPECT_FALSE(tally.overlap);
  d.x[0] = 13.0;
  EXPECT_TRUE(grow_step(d, box, {9.0, 9.0, 1.5}).overlap);
}

// Gaps as small as the rounding of coordinates, 2^-46 of the longer side, are not used.
TEST(Growth, LeavesGapsThatRoundingMayHaveMade) {
  EXPECT_EQ(usable_gap(-1.0, 64.0), 0.0);
  EXPECT_EQ(usable_gap(0x1p-40, 64.0), 0.0);
  EXPECT_EQ(usable_gap(0x1.8p-40, 64.0), 0.75 * 0x1.8p-40);
}

// A disk that touches a wall is within it; one further by the last bit is not. Periodic sides do not matter.
TEST(Growth, DisksLieWithinWallsToTheLastBit) {
  const Domain walls = test::box_of(8.0, 4.0);
  for (const Vec2 p : {Vec2{1.0, 1.0}, Vec2{7.0, 3.0}}) {
    EXPECT_TRUE(within_sides(walls, p.x, p.y, 1.0));
    const double outwards = p.x == 1.0 ? 0.0 : 8.0;
    const double x = std::nextafter(p.x, outwards), y = std::nextafter(p.y, outwards);
    EXPECT_FALSE(within_sides(walls, x, p.y, 1.0)) << x;
    EXPECT_FALSE(within_sides(walls, p.x, y, 1.0)) << y;
    Disks d = test::disks_of({{x, p.y, 0.0, 0.0, 1.0, 1.0}});
    d.radius = {1.0};
    EXPECT_TRUE(grow_step(d, walls, {1.0}).overlap);
    EXPECT_TRUE(grow_by_cells(Executor(1), d, walls, {1.0}).overlap);
    EXPECT_TRUE(within_sides(test::box_of(8.0, 4.0, test::Periodic::x), x, p.y, 1.0));
    EXPECT_TRUE(within_sides(test::box_of(8.0, 4.0, test::Periodic::y), p.x, y, 1.0));
  }
}

void expect_same_step(const GrowthTally& tally, const Disks& d, const GrowthTally& plain, const Disks& other) {
  EXPECT_EQ(state_hash(d), state_hash(other));
  EXPECT_EQ(tally.lacking, plain.lacking);
  EXPECT_EQ(tally.most_lack, plain.most_lack);
  EXPECT_EQ(tally.area.value(), plain.area.value());
  EXPECT_EQ(tally.lack.value(), plain.lack.value());
  if (plain.lacking == 0) {
    EXPECT_EQ(tally.overlap, plain.overlap);
  }
}

// Some disks lack something, others have their radii, and of these two may overlap.
TEST(Growth, StepsByCellsAndByListsDoWhatThePlainOneDoes) {
  test::Draws draws(6);
  const Executor executor(2, 100);
  int overlaps = 0;
  for (int k = 0; k < 24; ++k) {
    Domain box;
    box.width = 30.0;
    box.height = 20.0;
    test::set_sides(box, k % 2 == 0 ? SideKind::periodic : SideKind::wall, SideKind::wall);
    const Disks start = test::disks_of(test::random_disks(draws, box, 25, {0.2, 1.5}));
    Disks plain = start;
    if (k % 4 > 1) plain.x[7] = plain.x[3] + 0.5 * plain.radius[3], plain.y[7] = plain.y[3];
    Disks by_cells = plain, by_lists = plain;
    std::vector<double> target;
    for (const double r : plain.radius) target.push_back(k % 3 == 0 || draws.in(0, 1) < 0.3 ? r : r * draws.in(1, 2));
    const GrowthTally tally = grow_step(plain, box, target);
    overlaps += tally.lacking == 0 && tally.overlap ? 1 : 0;
    expect_same_step(grow_by_cells(executor, by_cells, box, target), by_cells, tally, plain);
    std::vector<std::uint32_t> all(plain.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto visit_all = [&](const auto& visit) {
      for (std::size_t i = 0; i < all.size(); ++i) visit(i, all);
    };
    expect_same_step(grow_by_lists(executor, by_lists, box, target, visit_all), by_lists, tally, plain);
  }
  EXPECT_EQ(overlaps, 4);
}

// The plain step compared with its definition over all pairs: each gap is divided in proportion to what both disks
// lack.
TEST(Growth, StepTakesTheLeastOfAllGaps) {
  test::Draws draws(5);
  for (int k = 0; k < 20; ++k) {
    Domain box;
    box.width = 30.0;
    box.height = 20.0;
    test::set_sides(box, k % 2 == 0 ? SideKind::periodic : SideKind::wall, SideKind::wall);
    State state;
    state.disks = test::disks_of(test::random_disks(draws, box, 25, {0.2, 1.5}));
    Disks& d = state.disks;
    std::vector<double> target;
    for (const double r : d.radius) target.push_back(draws.in(0, 1) < 0.3 ? r : r * draws.in(1, 2));
    const std::vector<double> before = d.radius;
    grow_step(d, box, target);
    for (std::size_t i = 0; i < d.size(); ++i) {
      double room = std::min(target[i] - before[i], 0.75 * std::min(d.y[i] - before[i], 20.0 - d.y[i] - before[i]));
      if (k % 2 == 1) room = std::min(room, 0.75 * std::min(d.x[i] - before[i], 30.0 - d.x[i] - before[i]));
      for (std::size_t j = 0; j < d.size() && target[i] > before[i]; ++j) {
        if (j == i) continue;
        double dx = d.x[j] - d.x[i];
        if (k % 2 == 0) dx = std::remainder(dx, 30.0);
        const double gap = std::hypot(dx, d.y[j] - d.y[i]) - before[i] - before[j];
        const double both = target[i] - before[i] + target[j] - before[j];
        room = std::min(room, 0.75 * gap * (target[i] - before[i]) / both);
      }
      EXPECT_NEAR(d.radius[i], before[i] + room, 1e-12) << i;
    }
  }
}

TEST(Growth, ScalesExactlyWithPowersOfTwo) {
  const auto state_of = [](double unit, double mass) {
    const std::string disks =
        fmt::format("[[disks]]\ncount = 60\npositions = \"growth\"\nradius = {{ uniform = [{}, {}] }}\nmass = {}\n",
                    unit, 3.0 * unit, mass);
    return initial_state(
        scene_from(text_of(fmt::format("{}width = {}\nheight = {}", periodic, 32.0 * unit, 32.0 * unit), disks)));
  };
  const State one = state_of(1.0, 1.0);
  const State large = state_of(0x1p20, 0x1p-20);
  for (std::size_t i = 0; i < one.disks.size(); ++i) {
    EXPECT_EQ(large.disks.x[i], 0x1p20 * one.disks.x[i]);
    EXPECT_EQ(large.disks.y[i], 0x1p20 * one.disks.y[i]);
  }
}

TEST(Growth, SeedsDifferAndMassesDoNotMatter) {
  const std::string text = text_of(std::string(periodic) + "packing_fraction = 0.7", group(60, "{ uniform = [1, 2] }"));
  const State one = initial_state(scene_from(text));
  EXPECT_EQ(one.disks.x, initial_state(scene_from(text)).disks.x);
  EXPECT_EQ(one.disks.x, initial_state(scene_from(test::replaced(text, "mass = 1", "mass = 7"))).disks.x);
  EXPECT_NE(one.disks.x, initial_state(scene_from(test::replaced(text, "seed = 11", "seed = 12"))).disks.x);
}

TEST(Growth, JamsWithAClearMessage) {
  const std::string text =
      text_of(std::string(periodic) + "packing_fraction = 0.89", group(30, "{ uniform = [1, 2] }"));
  const std::string message = test::complaint(text);
  EXPECT_THAT(message, HasSubstr("gas.toml:"));
  EXPECT_THAT(message, HasSubstr("disks.0.positions: \"growth\" stalls at packing fraction 0.8"));
  EXPECT_THAT(message, HasSubstr("slowness = 10"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_THAT(test::complaint(text + "[growth]\nsteps = 5\n"), HasSubstr("\"growth\" ends at packing fraction 0."));
}

// A disk that fills the box stays a little too small for ever. Across periodic sides it meets nothing, and then a
// little room is enough.
TEST(Growth, RefusesDisksThatFillTheBox) {
  const auto said = [](const std::string& box, const std::string& radius) {
    return test::complaint(text_of(box, group(3, "0.2") + group(2, radius)));
  };
  EXPECT_THAT(
      said("width = 1.0\nheight = 11.0", "0.5"),
      HasSubstr("disks.1.positions: \"growth\" never ends if a disk fills the box from wall to wall: disk 3 has the "
                "diameter 1, and the box is 1 wide; expected a larger box, smaller disks, or a lattice"));
  EXPECT_THAT(said("width = 11.0\nheight = 1.0", "0.5"), HasSubstr("and the box is 1 high; "));
  EXPECT_EQ(said("width = 1.000001\nheight = 11.0", "0.5"), "");
  EXPECT_EQ(said("width = 11.0\nheight = 2.0\nbottom = \"periodic\"\ntop = \"periodic\"", "0.5"), "");
}

// Each flight is a run of its own: crowded windows of earlier flights do not count. If the time of a flight stands
// still, as for disks that others enclose, this is reported as a jam of the group that grows.
TEST(Growth, JamsWhereTheTimeOfAFlightStandsStill) {
  const std::string fixed = "[[disks]]\nfixed = true\ncount = 1\npositions = [[5, 5]]\nradius = 1\n";
  const Scene scene = scene_from(text_of("width = 10\nheight = 10", fixed + group(60, "0.6")));
  const GrowthTools plain = plain_growth();
  int flights = 0;
  GrowthTools tools = plain;
  tools.fly = [&](const Scene& flight, State state, const std::function<void()>& watch) {
    EXPECT_EQ(state.time, 0.0);
    EXPECT_EQ(state.stall.frames, 0U);
    EXPECT_EQ(state.stall.since, 0.0);
    if (++flights == 3) throw PhysicsError("time almost stands still");
    state = plain.fly(flight, std::move(state), watch);
    state.stall = {100, 7.0};
    return state;
  };
  try {
    initial_state(scene, place_at_random, tools);
    ADD_FAILURE() << "no jam was reported; grown in " << flights << " flights";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, HasSubstr("disks.1.positions: \"growth\" jams at packing fraction 0."));
    EXPECT_THAT(message, HasSubstr("no fixed disks and walls that enclose others"));
  }
  EXPECT_EQ(flights, 3);
}

TEST(Growth, RefusesWhatItCannotDo) {
  const std::string other = "[[disks]]\ncount = 3\npositions = \"random\"\nradius = 1\nmass = 1\n";
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", group(3, "1") + other)),
              HasSubstr("disks.1.positions: cannot be used with \"growth\" of disks.0"));
  const std::string fixed = "[[disks]]\nfixed = true\ncount = 3\npositions = \"growth\"\nradius = 1\n";
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", group(3, "1") + fixed)),
              HasSubstr("disks.1.positions: is \"growth\" for fixed disks"));
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", fixed + other)),
              HasSubstr("disks.0.positions: is \"growth\" for fixed disks"));
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", other, "[growth]\nslowness = 2\n")),
              HasSubstr("growth: no group grows"));
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", group(3, "1"), "[growth]\nslowness = 0\n")),
              HasSubstr("growth.slowness: is 0"));
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", group(3, "1"), "[growth]\nslowness = 1e300\n")),
              HasSubstr("expected a number from 0.001 to 10000"));
  EXPECT_THAT(test::complaint(text_of("width = 50\nheight = 50", group(3, "1"), "[growth]\nslow = 2\n")),
              HasSubstr("growth.slow: unknown key"));
}

// The scene, written out and read again, grows the same disks.
TEST(Growth, SurvivesBeingWrittenOut) {
  const Scene scene = scene_from(text_of(std::string(periodic) + "packing_fraction = 0.6",
                                         group(20, "1") + group(20, "2"), "[growth]\nslowness = 3\nsteps = 200\n"));
  const Scene again = scene_from(resolved_toml(scene));
  EXPECT_EQ(again.growth.slowness, 3.0);
  EXPECT_EQ(again.growth.steps, 200U);
  EXPECT_EQ(initial_state(again).disks.x, initial_state(scene).disks.x);
}

}  // namespace
}  // namespace carom
