// Walls and fixed disks in the choice of a method: the collisions of disks with them count.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/load/method_choice.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::scene_from;

double collisions(const Scene& scene, const State& start) {
  const auto engine = make_parallel_engine(scene, start, {1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return static_cast<double>(engine->state().counters.collisions) / engine->state().time;
}

// In a slot of 1.1 diameters a disk meets the walls eight times between two collisions with disks: steps that are short
// only for the latter would lose 4.5 % of them.
TEST(WallsInTheWay, ASlotAsksForStepsThatAreShortAgainstItsWalls) {
  const std::string slot =
      "[box]\nwidth = 1190.0\nheight = 1.1\nleft = \"periodic\"\nright = \"periodic\"\n[[disks]]\ncount = 500\n"
      "positions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0\n[run]\nt_end = 300.0\n";
  Scene scene = scene_from(slot);
  EXPECT_NEAR(choose_method(scene, 1e-2).scales.wall_rate, 8.0, 0.1);
  const State start = initial_state(scene);
  const double exact = collisions(scene, start);
  scene.run = {Method::pairwise, choose_method(scene, 1e-2).offers.at(0).dt, 300.0};
  EXPECT_NEAR(collisions(scene, start) / exact, 1.0, 1e-2 + 3.0 * std::sqrt(2.0 / 60'000.0));
}

// In an equal box without walls there are no such collisions; fixed disks count by their circumference.
TEST(WallsInTheWay, WhatStandsInTheWayIsCountedAndPaidFor) {
  const auto choice = [](const std::string& fixed) {
    return choose_method(scene_from("[box]\nwidth = 50.0\nheight = 40.0\nleft = \"periodic\"\nright = \"periodic\"\n"
                                    "bottom = \"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = 10\nradius = 0.5\n"
                                    "mass = 1.0\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\n" +
                                    fixed + "[run]\nt_end = 100.0\n"),
                         1e-2);
  };
  const MethodChoice open = choice("");
  EXPECT_EQ(open.scales.wall_rate, 0.0);
  const MethodChoice pegs = choice("[[disks]]\ncount = 40\npositions = \"square\"\nradius = 1.0\nfixed = true\n");
  const double left = 2000.0 - 40.0 * M_PI * 2.25;
  EXPECT_NEAR(pegs.scales.wall_rate, 40.0 * 2.0 * M_PI * 1.5 / (std::sqrt(2.0 * M_PI) * left), 1e-12);
  EXPECT_GT(pegs.offers.at(1).seconds, 10.0 * open.offers.at(1).seconds);
}

// Errors of pairwise with moving images are not known. exact has none, and "auto" is refused.
TEST(WallsInTheWay, AShearedBoxLeavesExactAlone) {
  const Scene couette = load_scene(CAROM_SOURCE_DIR "/scenes/couette.toml");
  const MethodChoice choice = choose_method(couette, 0.03);
  EXPECT_FALSE(choice.offers.at(0).possible);
  EXPECT_EQ(choice.best, 1);
}

}  // namespace
}  // namespace carom
