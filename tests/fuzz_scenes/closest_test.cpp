// The checks of random scenes find overlaps: across sides, in a shear, with walls, and with moving obstacles.
#include "tests/fuzz_scenes/closest.hpp"

#include <gtest/gtest.h>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/fuzz_scenes/sanity.hpp"

namespace carom::fuzz {
namespace {

// For a box of 10 x 8 with two disks of radius 1, which are then moved to these places.
Closest closest_at(const std::string& keys, Vec2 a, Vec2 b, double time = 0.0) {
  const Scene scene = parse_scene("[box]\nwidth = 10\nheight = 8\n" + keys +
                                      "\n[[disks]]\ncount = 2\npositions = [[3, 3], [3, 5.1]]\nradius = 1\nmass = 1\n"
                                      "[run]\nt_end = 100\n",
                                  "test", ".");
  State state = initial_state(scene);
  state.disks.x = {a.x, b.x};
  state.disks.y = {a.y, b.y};
  return closest_of(state.disks, state.obstacles, scene, time);
}

const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

TEST(Closest, SeesPairsAcrossSides) {
  EXPECT_NEAR(closest_at("", {3, 3}, {4.5, 3}).gap, -0.5, 1e-12);
  EXPECT_NEAR(closest_at(periodic, {0.5, 3}, {9.0, 3}).gap, -0.5, 1e-12);
  EXPECT_NEAR(closest_at(periodic, {0.5, 0.5}, {9.5, 7.5}).gap, std::sqrt(2.0) - 2.0, 1e-12);
  EXPECT_GE(closest_at(periodic, {3, 3}, {3, 5.1}).gap, 0.0);
  // At time 2 the upper images have moved by 2 * 0.1 * 8.
  EXPECT_NEAR(closest_at(periodic + "shear_rate = 0.1\n", {5.0, 7.5}, {3.4, 0.5}, 2.0).gap, -1.0, 1e-12);
}

TEST(Closest, SeesSidesAndObstacles) {
  EXPECT_NEAR(closest_at("", {0.75, 3}, {5, 5}).gap, -0.25, 1e-12);
  EXPECT_NEAR(closest_at("top = { motion = { velocity = [0, -0.01] } }", {3, 3}, {5, 6.5}, 60.0).gap, -0.1, 1e-12);
  EXPECT_NEAR(closest_at("left = \"sink\"", {0.75, 3}, {5, 5}).gap, -0.25, 1e-12);
  const std::string wall = periodic + "[[walls]]\nfrom = [7, 0]\nto = [7, 6]\n";
  EXPECT_NEAR(closest_at(wall, {6.5, 4}, {3, 3}).gap, -0.5, 1e-12);
  EXPECT_NEAR(closest_at(wall, {6.5, 7.75}, {3, 3}).gap, std::sqrt(0.3125) - 1.0, 1e-12)
      << "the end of the wall, across the top";
  EXPECT_NEAR(closest_at(wall + "motion = { velocity = [0.5, 0] }\n", {1.5, 3}, {5, 3}, 8.0).gap, -0.5, 1e-12);
}

TEST(Sanity, TellsOfOverlapsWithinAWindow) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 10\nheight = 8\n[[disks]]\ncount = 2\npositions = [[3, 3], [3, 5.1]]\nradius = 1\nmass = 1\n"
      "[run]\nt_end = 100\n",
      "test", ".");
  const State start = initial_state(scene);
  Sanity sanity(scene, start);
  Disks disks = start.disks;
  sanity.look_within(disks, 1.0);
  EXPECT_EQ(sanity.fault(), "");
  disks.y = {3.0, 4.9};
  sanity.look_within(disks, 2.0);
  EXPECT_NE(sanity.fault().find("at t = 2: disks 0 and 1 overlap"), std::string::npos) << sanity.fault();
}

// The sides of a run gave momentum or energy that is not in its counters.
TEST(Sanity, TellsOfMomentumAndEnergyFromNowhere) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 10\nheight = 8\n[[disks]]\ncount = 2\npositions = [[3, 3], [3, 5.1]]\n"
      "velocities = [[1, 0], [0, 0]]\nradius = 1\nmass = 1\n[run]\nt_end = 100\n",
      "test", ".");
  State state = initial_state(scene);
  Sanity momentum(scene, state);
  Sanity energy(scene, state);
  state.time = 1.0;
  state.disks.vx = {-1.0, 0.0};
  state.counters.wall_impulse[1] = 2.0;
  momentum.look(state, "");
  EXPECT_EQ(momentum.fault(), "");
  state.counters.wall_impulse[1] = 1.5;
  state.time = 2.0;
  momentum.look(state, "");
  EXPECT_NE(momentum.fault().find("momentum along x"), std::string::npos) << momentum.fault();
  state.disks.vx = {-1.25, 0.0};
  state.counters.wall_impulse[1] = 2.25;
  energy.look(state, "");
  EXPECT_NE(energy.fault().find("energy went from"), std::string::npos) << energy.fault();
}

}  // namespace
}  // namespace carom::fuzz
