// Long runs of the exact method among fixed disks and inner walls: no overlap after a million contacts, energy
// conserved, and the bits of the reference. The hopper is compared with Beverloo's law.
#include <gtest/gtest.h>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"

namespace carom {
namespace {

Scene among_pegs(const std::string& sides, double gravity) {
  return parse_scene(
      "[box]\nwidth = 40.0\nheight = 40.0\n" + sides + "[physics]\ngravity = " + std::to_string(gravity) +
          "\n[[disks]]\nfixed = true\ncount = 300\npositions = \"random\"\nradius = { uniform = [0.05, 0.8] }\n"
          "[[disks]]\ncount = 300\npositions = \"random\"\nvelocities = { uniform = 3.0 }\n"
          "radius = { uniform = [0.1, 0.4] }\nmass = { uniform = [1.0, 5.0] }\n"
          "[run]\nmethod = \"exact\"\nt_end = 1e9\n",
      "pegs.toml", "");
}

void expect_no_overlap(const Scene& scene, Count contacts) {
  const State start = initial_state(scene);
  Domain box = scene.box;
  const auto cells = place_obstacles(start.obstacles, box);
  const auto engine = make_parallel_engine(scene, start, {2, 64});
  double deepest = 0.0;
  for (Count k = 0; engine->state().counters.wall_collisions < contacts; ++k) {
    engine->step();
    if (k % 16 != 0) continue;
    deepest = std::max({deepest, wall_overlap(engine->state().disks, box), max_overlap(engine->state().disks, box)});
  }
  EXPECT_LT(deepest, 1e-12);
  const double gravity = scene.physics.gravity.down;
  const double before = energy_of(start.disks, gravity).total();
  EXPECT_NEAR(energy_of(engine->state().disks, gravity).total(), before, 1e-9 * before);
}

void expect_the_references_bits(const Scene& scene, Count contacts) {
  const State start = initial_state(scene);
  const auto reference = make_reference_engine(scene, start);
  const auto engine = make_parallel_engine(scene, start, {3, 256});
  while (reference->state().counters.wall_collisions < contacts) {
    reference->step();
    engine->step();
    ASSERT_EQ(state_hash(reference->state().disks), state_hash(engine->state().disks)) << reference->state().time;
  }
}

class AmongPegs : public ::testing::TestWithParam<double> {};

TEST_P(AmongPegs, NoOverlapAfterAMillionContacts) {
  expect_no_overlap(among_pegs("left = \"periodic\"\nright = \"periodic\"\n", GetParam()), 1'000'000);
}

TEST_P(AmongPegs, ReferenceAfterManyContacts) {
  expect_the_references_bits(among_pegs("", GetParam()), 200'000);
}

INSTANTIATE_TEST_SUITE_P(Gravity, AmongPegs, ::testing::Values(0.0, 1.0));

// Inner and outer corners, an acute wedge, free ends, and a closed polygon.
Scene among_walls(double gravity) {
  return parse_scene(
      "[box]\nwidth = 20.0\nheight = 20.0\nleft = \"periodic\"\nright = \"periodic\"\n[physics]\ngravity = " +
          std::to_string(gravity) +
          "\n[[walls]]\npoints = [[3, 3], [6, 9], [6.5, 2]]\n[[walls]]\nfrom = [9, 12]\nto = [19, 14]\n"
          "[[walls]]\npoints = [[9, 3], [13, 4], [14, 9], [10, 8], [9, 3]]\n[[walls]]\nfrom = [0, 14]\nto = [5, 19]\n"
          "[[disks]]\ncount = 120\npositions = \"random\"\nvelocities = { uniform = 3.0 }\n"
          "radius = { uniform = [0.05, 0.3] }\nmass = { uniform = [1.0, 5.0] }\n"
          "[run]\nmethod = \"exact\"\nt_end = 1e9\n",
      "walls.toml", "");
}

class AmongWalls : public ::testing::TestWithParam<double> {};

TEST_P(AmongWalls, NoOverlapAfterManyContacts) {
  expect_no_overlap(among_walls(GetParam()), 100'000);
}

TEST_P(AmongWalls, ReferenceAfterManyContacts) {
  expect_the_references_bits(among_walls(GetParam()), 10'000);
}

INSTANTIATE_TEST_SUITE_P(Gravity, AmongWalls, ::testing::Values(0.0, 1.0));

// A vibrating floor and two vibrating inner walls; a thermostat removes the energy that they give. A disk that has just
// left a sine is not tested for 2^-40 of the period, in which it moves by a little more than 1e-12.
Scene among_moving_walls(const std::string& shape) {
  const std::string motion = ", shape = \"" + shape + "\" }\n";
  return parse_scene(
      "[box]\nwidth = 20.0\nheight = 20.0\nleft = \"periodic\"\nright = \"periodic\"\n"
      "bottom = { motion = { vibrate = [0, 0.5], period = 1.1" +
          motion.substr(0, motion.size() - 1) +
          " }\n"
          "[physics]\nthermostat = { kind = \"langevin\", temperature = 4.0, rate = 1.0, dt = 0.5 }\n"
          "[[walls]]\npoints = [[3, 3], [6, 9], [6.5, 3]]\nmotion = { vibrate = [1, 0.5], period = 1.3" +
          motion + "[[walls]]\nfrom = [9, 12]\nto = [16, 14]\nmotion = { vibrate = [0, 2], period = 2.0" + motion +
          "[[disks]]\ncount = 120\npositions = \"random\"\nvelocities = { uniform = 3.0 }\n"
          "radius = { uniform = [0.05, 0.3] }\nmass = { uniform = [1.0, 5.0] }\n"
          "[run]\nmethod = \"exact\"\nt_end = 1e9\n",
      "moving.toml", "");
}

class AmongMovingWalls : public ::testing::TestWithParam<std::string> {};

TEST_P(AmongMovingWalls, NoOverlapAfterAMillionContacts) {
  const Scene scene = among_moving_walls(GetParam());
  const State start = initial_state(scene);
  const auto engine = make_parallel_engine(scene, start, {1, 1});
  double deepest = 0.0;
  for (Count k = 0; engine->state().counters.wall_collisions < 1'000'000; ++k) {
    engine->step();
    if (k % 16 != 0) continue;
    const State& now = engine->state();
    Domain here = box_at(scene.box, now.time);
    const auto cells = place_obstacles(now.obstacles, here, motions_of(scene));
    deepest = std::max({deepest, wall_overlap(now.disks, here), max_overlap(now.disks, here)});
  }
  EXPECT_LT(deepest, GetParam() == "sine" ? 1e-11 : 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Shapes, AmongMovingWalls, ::testing::Values("parabola", "sine"));

// Disks per unit of time through an opening of this width, while the 101st to the 200th leave.
double flow_through(double opening) {
  const std::string left = std::to_string(8.0 - 0.5 * opening);
  const std::string right = std::to_string(8.0 + 0.5 * opening);
  const Scene scene =
      load_scene(CAROM_SOURCE_DIR "/scenes/hopper.toml", {{"walls.0.points", "[[0, 14], [" + left + ", 7.5]]"},
                                                          {"walls.1.points", "[[16, 14], [" + right + ", 7.5]]"},
                                                          {"disks.0.count", "450"},
                                                          {"disks.0.region", "[0, 14.5, 16, 28]"},
                                                          {"run.dt", "0.0035"}});
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2});
  double first = 0.0;
  while (engine->state().counters.removed < 200) {
    engine->step();
    if (engine->state().counters.removed <= 100) first = engine->state().time;
  }
  return 100.0 / (engine->state().time - first);
}

// D^(3/2) gives a ratio of 2.83; Beverloo's law with k = 1 gives 3.56. A flow in proportion to the opening would give
// 2.
TEST(Hopper, FlowsAsBeverlooSays) {
  const double ratio = flow_through(4.0) / flow_through(2.0);
  EXPECT_GT(ratio, 2.6);
  EXPECT_LT(ratio, 3.6);
}

}  // namespace
}  // namespace carom
