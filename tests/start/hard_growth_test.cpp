// Growth, given its tools: how flights treat sides and obstacles, how long they last, and when growth ends.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/start/growth.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::complaint;
using test::replaced;
using test::scene_from;
using testing::HasSubstr;

// A box with four walls, a peg and an inner wall, all elastic and at rest.
const std::string plain = R"(seed = 3
[box]
width = 24.0
height = 20.0
wall_restitution = 1.0
left = "wall"
right = "wall"
[physics]
restitution = 1.0
[[disks]]
count = 82
positions = "growth"
radius = { uniform = [0.8, 1.3] }
mass = 1.0
[[disks]]
fixed = true
count = 1
positions = [[8.0, 8.0]]
radius = 2.0
[[walls]]
from = [14.0, 6.0]
to = [18.0, 12.0]
kind = "wall"
[run]
t_end = 1.0
)";

void expect_same_places(const std::string& text) {
  const State expected = initial_state(scene_from(plain));
  for (const State& state : {initial_state(scene_from(text)), parallel_initial_state(scene_from(text), 2)}) {
    EXPECT_EQ(state.disks.x, expected.disks.x) << text;
    EXPECT_EQ(state.disks.y, expected.disks.y) << text;
  }
}

// Whatever sides and obstacles are in the run: during growth all of them are elastic walls at rest.
TEST(HardGrowth, SidesAndObstaclesAreElasticWallsAtRest) {
  expect_same_places(plain);
  expect_same_places(replaced(plain, "wall_restitution = 1.0", "wall_restitution = 0.3"));
  expect_same_places(replaced(plain, "left = \"wall\"", "left = { restitution = 0.0 }"));
  expect_same_places(replaced(plain, "left = \"wall\"", "left = { temperature = 5.0 }"));
  expect_same_places(replaced(plain, "right = \"wall\"", "right = \"sink\""));
  expect_same_places(replaced(plain, "\nrestitution = 1.0", "\nrestitution = 0.2"));
  expect_same_places(replaced(plain, "kind = \"wall\"", "kind = \"sink\""));
  expect_same_places(replaced(plain, "kind = \"wall\"", "restitution = 0.1"));
  expect_same_places(replaced(plain, "kind = \"wall\"", "motion = { velocity = [0.5, 0.0] }"));
}

// A peg takes 0.7 of the box. The disks take 0.15, half of the rest, in the four corners, so random addition at 0.25 of
// the box would find no room.
TEST(HardGrowth, StartsAtASmallShareOfWhatPegsLeave) {
  const std::string text =
      "seed = 5\n[box]\nwidth = 20.0\nheight = 20.0\n[[disks]]\nfixed = true\ncount = 1\npositions = [[10.0, 10.0]]\n"
      "radius = 9.44\n[[disks]]\ncount = 76\npositions = \"growth\"\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 1.0\n";
  EXPECT_EQ(complaint(text), "");
}

// Tools that only record their calls.
struct Notes {
  std::vector<double> flights;  // lengths of the flights
  Count events = 0;             // collisions in each flight
  std::function<GrowthTally(std::size_t)> tally;
  std::size_t steps = 0;
  Disks seen;  // disks of the last flight

  GrowthTools tools() {
    return {[this](const Scene& scene, State state, const std::function<void()>&) {
              flights.push_back(scene.run.t_end);
              seen = state.disks;
              state.counters.collisions = events;
              return state;
            },
            [this](Disks& d, const Domain&, const std::vector<double>& target) {
              d.radius = target;
              return tally(steps++);
            },
            {}};
  }
};

const std::string few =
    "seed = 3\n[box]\nwidth = 24.0\nheight = 20.0\n[[disks]]\ncount = 10\npositions = \"growth\"\nradius = 0.4\nmass = "
    "1.0\n[growth]\nslowness = 3.0\nsteps = 7\n[run]\nt_end = 1.0\n";

GrowthTally tally_of(std::size_t lacking, bool overlap, double lack) {
  GrowthTally tally;
  tally.lacking = lacking;
  tally.overlap = overlap;
  tally.lack.add(lack);
  return tally;
}

std::string complaint_of(Notes& notes, const std::string& text) {
  try {
    initial_state(scene_from(text), place_at_random, notes.tools());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// All disks have their radii, but two overlap by rounding: flights go on until none do.
TEST(HardGrowth, EndsWhereNoneOverlap) {
  Notes notes;
  notes.tally = [](std::size_t step) { return tally_of(0, step < 3, 0.0); };
  EXPECT_EQ(complaint_of(notes, few), "");
  EXPECT_EQ(notes.steps, 4U);
  EXPECT_EQ(notes.flights.size(), 3U);
}

// There are as many steps as [growth] allows, with a flight before each.
TEST(HardGrowth, GivesUpAfterTheStepsOfTheScene) {
  Notes notes;
  notes.tally = [](std::size_t step) { return tally_of(1, false, std::pow(0.5, static_cast<double>(step))); };
  EXPECT_THAT(complaint_of(notes, few), HasSubstr("\"growth\" ends at packing fraction"));
  EXPECT_EQ(notes.flights.size(), 7U);
}

// Growth stalls if after a hundred steps more than 0.98 of what was lacking is left, and goes on if less is left.
TEST(HardGrowth, StallsWhereLittleIsGained) {
  const std::string text = replaced(few, "steps = 7", "steps = 250");
  for (const double share : {0.985, 0.975}) {
    Notes notes;
    notes.tally = [&](std::size_t step) {
      return tally_of(1, false, std::pow(share, static_cast<double>(step) / 100.0));
    };
    EXPECT_THAT(complaint_of(notes, text), HasSubstr(share > 0.98 ? "\"growth\" stalls" : "\"growth\" ends"));
    EXPECT_EQ(notes.flights.size(), share > 0.98 ? 100U : 250U) << share;
  }
}

// A flight lasts 0.02 mean distances times the slowness, or less if disks would have more than 16 collisions each times
// the slowness: flights are halved at most, and then doubled again. For ten disks the limit is 16 * 3 * 10 / 2 = 240
// collisions together.
TEST(HardGrowth, FlightsAreAsLongAsCollisionsAllow) {
  Notes notes;
  notes.tally = [&](std::size_t step) {
    notes.events = step < 3 ? 1000 : 0;
    return tally_of(step < 8 ? 1 : 0, false, std::pow(0.5, static_cast<double>(step)));
  };
  EXPECT_EQ(complaint_of(notes, replaced(few, "steps = 7", "steps = 8")), "");
  const double most = 0.02 * 3.0;
  EXPECT_EQ(notes.flights,
            (std::vector{most, 0.5 * most, 0.25 * most, 0.125 * most, 0.25 * most, 0.5 * most, most, most}));
  Notes busy;
  busy.events = 300;  // 240 are wanted, so the next flight is four fifths as long
  busy.tally = [](std::size_t step) { return tally_of(step < 2 ? 1 : 0, false, 1.0); };
  EXPECT_EQ(complaint_of(busy, few), "");
  ASSERT_EQ(busy.flights.size(), 2U);
  EXPECT_DOUBLE_EQ(busy.flights[1], 0.8 * most);
}

// Velocities are normal deviates in units of the mean distance sqrt(width height / n), from the scene's seed. The mean
// of 2 n squares of such deviates has a standard deviation of sqrt(2 / (2 n)); the tolerance is four times that.
TEST(HardGrowth, FliesAtTheMeanDistanceInAUnitOfTime) {
  const auto velocities = [](const std::string& text) {
    Notes notes;
    notes.tally = [](std::size_t step) { return tally_of(step < 1 ? 1 : 0, false, 1.0); };
    EXPECT_EQ(complaint_of(notes, text), "");
    return std::pair(notes.seen.vx, notes.seen.vy);
  };
  const std::string many = replaced(replaced(few, "count = 10", "count = 400"), "radius = 0.4", "radius = 0.1");
  const auto [vx, vy] = velocities(many);
  ASSERT_EQ(vx.size(), 400U);
  double squares = 0.0;
  for (std::size_t i = 0; i < 400; ++i) squares += vx[i] * vx[i] + vy[i] * vy[i];
  EXPECT_NEAR(squares / 800.0, 24.0 * 20.0 / 400.0, 4.0 * 1.2 * std::sqrt(1.0 / 400.0));
  EXPECT_NE(velocities(replaced(many, "seed = 3", "seed = 4")).first, vx);
  EXPECT_NE(vx, vy);
}

}  // namespace
}  // namespace carom
