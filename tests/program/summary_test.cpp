// The pressure in a summary, computed by hand: which area and which kinetic energy it refers to.
#include "run/results/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/load/scene_file.hpp"
#include "core/measure/run_start.hpp"
#include "core/start/initial_state.hpp"

namespace carom {
namespace {

// A box of 10 x 10 with one disk of mass 2 at height 7.5; steps end at times that are exact in binary.
Scene scene_with(const std::string& sides, const std::string& physics, const std::string& velocity) {
  return parse_scene("[box]\nwidth = 10.0\nheight = 10.0\n" + sides + "[physics]\n" + physics +
                         "[[disks]]\ncount = 1\npositions = [[5.0, 7.5]]\nvelocities = [" + velocity +
                         "]\nradius = 0.5\nmass = 2.0\n[run]\nmethod = \"pairwise\"\ndt = 0.0625\nt_end = 1.0\n",
                     "one.toml", "");
}

Summary summary_of(const Scene& scene) {
  const EngineChoice choice{"reference", 1};
  State start = initial_state(scene);
  const RunStart remembered = run_start(start, scene);
  const std::unique_ptr<Engine> engine = make_engine(choice, scene, std::move(start));
  while (engine->state().time < scene.run.t_end) engine->step();
  return summarize(remembered, *engine, scene, choice);
}

// The disk moves at speed 4 along x, and after falling by 1 in a unit of time also at 2 downwards.
TEST(Summary, ThePressureIsFromTheEnergyOfMotionHalfwayBetweenStartAndEnd) {
  const Summary s = summary_of(scene_with("", "gravity = 2.0\n", "[4.0, 0.0]"));
  EXPECT_EQ(s.counters.virial, 0.0);
  EXPECT_EQ(s.kinetic_initial, 16.0);
  EXPECT_EQ(s.kinetic_final, 20.0);
  EXPECT_DOUBLE_EQ(s.pressure, 18.0 / (10.0 * 10.0));
}

// The same fall from rest: the mean between 0 and 4 is unknown.
TEST(Summary, ThereIsNoPressureWhereTheEnergyOfMotionChangesByMoreThanAQuarter) {
  EXPECT_TRUE(std::isnan(summary_of(scene_with("", "gravity = 2.0\n", "[0.0, 0.0]")).pressure));
  EXPECT_TRUE(std::isnan(summary_of(scene_with("", "gravity = 2.0\n", "[3.0, 0.0]")).pressure)) << "9 and 13";
}

// The disk falls from rest by 7, until t = 0.66, and stays on the floor: it is at rest at both ends, but moved in
// between.
TEST(Summary, ThereIsNoPressureOfAFallFromRestToRest) {
  const Summary s = summary_of(scene_with("wall_restitution = 0.0\n", "gravity = 32.0\n", "[0.0, 0.0]"));
  EXPECT_EQ(s.kinetic_final, 0.0);
  EXPECT_GT(s.counters.wall_collisions, 0U);
  EXPECT_TRUE(std::isnan(s.pressure)) << s.pressure;
  EXPECT_EQ(summary_of(scene_with("", "", "[0.0, 0.0]")).pressure, 0.0) << "a disk that never moves has no pressure";
}

// There is no mean over a time of 0.
TEST(Summary, ThereIsNoPressureOfNoTime) {
  Scene scene = scene_with("", "", "[1.0, 0.0]");
  scene.run.t_end = 0.0;
  const Summary s = summary_of(scene);
  EXPECT_TRUE(std::isnan(s.pressure)) << s.pressure;
  EXPECT_NE(table_text(s, "").find("no time has passed"), std::string::npos);
  scene = scene_with("", "", "[0.0, 0.0]");
  scene.run.t_end = 0.0;
  EXPECT_EQ(summary_of(scene).pressure, 0.0) << "a disk at rest";
}

// The floor rises by 2, and is at 1 halfway through the run.
TEST(Summary, ThePressureIsThatOfTheRoomHalfwayWhereSidesMove) {
  const Summary s = summary_of(scene_with("bottom = { motion = { velocity = [0.0, 2.0] } }\n", "", "[1.0, 0.0]"));
  EXPECT_EQ(s.counters.wall_collisions, 0U);
  EXPECT_DOUBLE_EQ(s.pressure, 1.0 / (10.0 * 9.0));
}

// After two and a half periods the floor is back in the middle, and at half time it is at its highest. The area is not
// that at half time, 10 (10 - 2 - 1), but that of the mean place. In the half period that remains the mean displacement
// is 2 a / 3 for a parabola and 2 a / pi for a sine.
TEST(Summary, ThePressureIsThatOfTheMeanRoomWhereSidesVibrate) {
  const auto pressure_on = [](const std::string& shape) {
    const std::string floor =
        "bottom = { place = 2.0, motion = { vibrate = [0.0, 1.0], period = 0.4, shape = \"" + shape;
    const Summary s = summary_of(scene_with(floor + "\" } }\n", "", "[1.0, 0.0]"));
    EXPECT_EQ(s.counters.wall_collisions, 0U);
    return s.pressure;
  };
  EXPECT_DOUBLE_EQ(pressure_on("parabola"), 1.0 / (10.0 * (8.0 - 2.0 / 3.0 / 5.0)));
  EXPECT_DOUBLE_EQ(pressure_on("sine"), 1.0 / (10.0 * (8.0 - 2.0 / std::numbers::pi / 5.0)));
}

// Velocities in a scene are relative to the flow, whose speed at height 7.5 is 1.25.
TEST(Summary, ThePressureInAShearIsOfMotionRelativeToTheFlow) {
  const std::string sides =
      "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.5\n";
  const Summary with_flow = summary_of(scene_with(sides, "", "[0.0, 0.0]"));
  EXPECT_EQ(with_flow.energy_final, 1.25 * 1.25);
  EXPECT_EQ(with_flow.kinetic_initial, 0.0);
  EXPECT_EQ(with_flow.kinetic_final, 0.0);
  EXPECT_EQ(with_flow.pressure, 0.0);
  EXPECT_DOUBLE_EQ(summary_of(scene_with(sides, "", "[1.0, 0.0]")).pressure, 1.0 / (10.0 * 10.0));
}

// A disk that rises by 2 falls behind the flow, which is faster there: by 1, or by 2 at twice the rate.
TEST(Summary, ThePressureInAShearIsOfTheEnergyHalfwayBetweenStartAndEndAsElsewhere) {
  const auto rising = [](const std::string& rate) {
    return summary_of(
        scene_with("left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n"
                   "shear_rate = " +
                       rate + "\n",
                   "", "[0.0, 2.0]"));
  };
  const Summary slow = rising("0.5");
  EXPECT_EQ(slow.kinetic_initial, 4.0);
  EXPECT_DOUBLE_EQ(slow.kinetic_final, 5.0);
  EXPECT_DOUBLE_EQ(slow.pressure, 4.5 / (10.0 * 10.0));
  const Summary fast = rising("1.0");
  EXPECT_DOUBLE_EQ(fast.kinetic_final, 8.0);
  EXPECT_TRUE(std::isnan(fast.pressure)) << fast.pressure;
}

}  // namespace
}  // namespace carom
