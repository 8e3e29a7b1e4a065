// Speeds of disks and rates of collisions, estimated from the scene alone.
#include "core/load/scene_scales.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/load/scene_file.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::scene_from;

// An elastic fluid at packing fraction 0.5 with a temperature of 1, diameter 1.
TEST(SceneScales, ScalesOfTheFluidAreThoseOfTheory) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/gas_million.toml", {{"disks.0.count", "10000"}});
  const SceneScales s = scales_of(scene);
  EXPECT_DOUBLE_EQ(s.disks, 10000.0);
  EXPECT_DOUBLE_EQ(s.diameter, 1.0);
  EXPECT_NEAR(s.packing_fraction, 0.5, 1e-12);
  EXPECT_NEAR(s.speed, 1.0, 1e-12);
  EXPECT_NEAR(s.collision_rate, 7.007, 0.02);  // Gamma at 0.5, from docs/reference_values.md
  EXPECT_FALSE(s.settles);
  EXPECT_FALSE(s.may_collapse);
}

// Collisions share out energy: that of fast heavy disks goes to light ones, that of spins to translation.
TEST(SceneScales, LightDisksBecomeFast) {
  const auto speed = [](const std::string& heavy, const std::string& light, const std::string& physics) {
    const std::string disks = "positions = \"random\"\nradius = 0.1\ncount = 50\n";
    return scales_of(scene_from("[box]\nwidth = 20.0\nheight = 20.0\n" + physics + "[[disks]]\n" + disks + heavy +
                                "[[disks]]\n" + disks + light + "[run]\nt_end = 1.0\n"))
        .speed;
  };
  const double rms = std::sqrt(50.0 * 0.5 * (1.0 + 1.0 / 100.0));  // the mean T = 50 and the mean of 1 / m
  EXPECT_NEAR(speed("mass = 100.0\nvelocities = { maxwell = 100.0 }\n", "mass = 1.0\n", ""), rms, 1e-12 * rms);
  const std::string rough = "[physics]\nroughness = { tangential_restitution = 1.0 }\n";
  const std::string spinning = "mass = 1.0\nspin_temperature = 30.0\n";
  EXPECT_NEAR(speed(spinning, spinning, rough), std::sqrt(10.0), 1e-12);
  const std::string turning = "mass = 1.0\nspin = 100.0\n";  // I w^2 = 0.5 0.01 10^4
  EXPECT_NEAR(speed(turning, turning, rough), std::sqrt(50.0 / 3.0), 1e-12);
}

// Maxwell's speeds depend on each disk's own mass: for two masses, each of half of the disks, they are the mean of T /
// m. The fastest disks are the light ones, or one listed with a high speed.
TEST(SceneScales, DrawnMassesHaveEachItsSpeed) {
  const auto scales = [](const std::string& disks) {
    return scales_of(scene_from("[box]\nwidth = 80.0\nheight = 80.0\n[[disks]]\npositions = \"random\"\n" + disks +
                                "[run]\nt_end = 1.0\n"));
  };
  const std::string many = "radius = 0.1\ncount = 2000\nvelocities = { maxwell = 2.0 }\n";
  const SceneScales two = scales(many + "mass = { choice = [1.0, 10000.0] }\n");
  EXPECT_NEAR(two.speed, std::sqrt(2.0 * 0.5 * (1.0 + 1e-4)), 0.05) << "by the numbers drawn of each mass";
  EXPECT_NEAR(two.fastest, fastest_share * std::sqrt(2.0), 0.05);
  const SceneScales few = scales(many + "mass = { choice = [1.0, 10000.0], weights = [1.0, 100.0] }\n");
  EXPECT_LT(few.speed, 0.3);
  EXPECT_GE(few.fastest, fastest_share * std::sqrt(2.0));
  const std::string one =
      "[[disks]]\npositions = [[40.0, 40.0]]\nradius = 0.1\nmass = 1.0\nvelocities = [[0.0, 90.0]]\n";
  EXPECT_GE(scales(many + "mass = 1.0\n" + one + "count = 1\n").fastest, 90.0);
}

// Half of the square of a drift or a listed velocity counts for each component, as collisions share it out.
TEST(SceneScales, DriftsAndListsCountByTheirComponents) {
  const auto speed = [](const std::string& velocities, const std::string& others) {
    return scales_of(scene_from("[box]\nwidth = 20.0\nheight = 20.0\n[[disks]]\npositions = \"random\"\nradius = "
                                "0.1\nmass = 1.0\ncount = 2\n" +
                                velocities + others + "[run]\nt_end = 1.0\n"))
        .speed;
  };
  const std::string heavy = "[[disks]]\npositions = \"random\"\nradius = 0.1\nmass = 100.0\ncount = 2\n";
  for (const char* const moving : {"drift = [3.0, 4.0]\n", "velocities = [[3.0, 4.0], [0.0, -5.0]]\n"}) {
    EXPECT_NEAR(speed(moving, ""), std::sqrt(12.5), 1e-12) << moving;
    EXPECT_NEAR(speed(moving, heavy), std::sqrt(6.25), 1e-12) << moving;
  }
}

// All disks that a source may draw count, not only its first.
TEST(SceneScales, SourcesHaveAllSizesThatTheyDraw) {
  const SceneScales s =
      scales_of(scene_from("[box]\nwidth = 80.0\nheight = 80.0\n[[sources]]\nside = \"left\"\n"
                           "rate = 500.0\nradius = { uniform = [0.1, 0.5] }\n"
                           "mass = { from_radius = 1.0 }\nvelocities = { uniform = 1.0 }\n"
                           "[run]\nt_end = 1.0\n"));
  EXPECT_LT(s.smallest_radius, 0.11);
  EXPECT_NEAR(s.diameter, 2.0 * std::sqrt((0.5 * 0.5 * 0.5 - 0.1 * 0.1 * 0.1) / (3.0 * 0.4)), 0.02);
}

// Z from docs/reference_values.md.
TEST(SceneScales, CompressibilityIsThatOfTheVirialSeries) {
  EXPECT_DOUBLE_EQ(compressibility(0.0), 1.0);
  EXPECT_NEAR(compressibility(0.05) / 1.108388, 1.0, 1e-3);
  EXPECT_NEAR(compressibility(0.3) / 2.06326, 1.0, 1e-3);
  EXPECT_NEAR(compressibility(0.5), 4.105, 1e-3 * 4.105 + 2e-3);  // the reference has an error of 2e-3
}

// The mean square of a component: v^2 / 3 for speeds between -v and v; (2 V)^2 for a wall that moves at V.
TEST(SceneScales, SpeedsAreThoseOfTheLawAndOfWalls) {
  const auto speed = [](const std::string& box, const std::string& disks) {
    return scales_of(scene_from("[box]\nwidth = 20.0\nheight = 20.0\n" + box +
                                "[[disks]]\npositions = \"random\"\nradius = 0.1\nmass = 1.0\ncount = 50\n" + disks +
                                "[run]\nt_end = 1.0\n"))
        .speed;
  };
  EXPECT_NEAR(speed("", "velocities = { uniform = 3.0 }\n"), std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(speed("left = { motion = { velocity = [2.0, 0.0] } }\n", ""), 4.0, 1e-12);
}

// ln(4 / (1 - e)) / (1 - e) is 36.9 for e = 0.9: a column of so many disks collapses on an elastic floor. A
// viscoelastic gas does not collapse, however much its fast disks lose.
TEST(SceneScales, CollapseNeedsAColumnOrALossAtRest) {
  const auto collapses = [](const std::string& physics, int count) {
    return scales_of(scene_from("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\n" + physics +
                                "[[disks]]\npositions = \"random\"\nradius = 0.1\nmass = 1.0\ncount = " +
                                std::to_string(count) + "\n[run]\nmethod = \"exact\"\nt_end = 1.0\n"))
        .may_collapse;
  };
  EXPECT_TRUE(collapses("gravity = 1.0\nrestitution = 0.9\n", 37));
  EXPECT_FALSE(collapses("gravity = 1.0\nrestitution = 0.9\n", 36));
  EXPECT_TRUE(collapses("restitution = 0.2\n", 50));
  EXPECT_FALSE(collapses("restitution = { viscoelastic = 0.3, least = 0.2 }\n", 50));
}

}  // namespace
}  // namespace carom
