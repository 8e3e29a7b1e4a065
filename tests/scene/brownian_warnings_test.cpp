// Settings that have no effect on Brownian disks, or not the expected one: one warning for each, with its key.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/load/scene_warnings.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// The effect of gravity and masses would depend on dt, or would be none.
TEST(BrownianWarnings, TellWhatDependsOnMoreThanTheScene) {
  const std::string start = R"(
[box]
width = 20.0
height = 20.0
[physics]
diffusion = 0.5
)";
  const std::string end = R"(
[[disks]]
count = 5
positions = "random"
radius = { uniform = [0.1, 0.2] }
mass = 1.0
[[disks]]
count = 5
fixed = true
positions = "random"
radius = 0.3
[run]
dt = 0.01
t_end = 1.0
)";
  const auto warned = [&](const std::string& physics, const std::string& last, const std::vector<Override>& sets = {}) {
    return scene_warnings(test::scene_from(start + physics + end + last, sets));
  };
  EXPECT_THAT(warned("", ""), testing::IsEmpty());
  EXPECT_THAT(
      warned("gravity = [0.0, 3.0]\n", ""),
      testing::ElementsAre(AllOf(HasSubstr("physics.gravity: Brownian disks"), HasSubstr("g dt / 2 = 0.015,"))));
  EXPECT_THAT(
      warned("restitution = 0.9\n", ""),
      testing::ElementsAre(AllOf(HasSubstr("physics.restitution: Brownian disks"), HasSubstr(" = 0.1 of contact"))));
  EXPECT_THAT(warned("", "", {{"box.wall_restitution", "0.5"}}),
              testing::ElementsAre(HasSubstr("box.wall_restitution: Brownian disks")));
  EXPECT_THAT(warned("", "", {{"box.left", "{ restitution = 0.5 }"}}),
              testing::ElementsAre(HasSubstr("box.left.restitution: Brownian disks")));
  EXPECT_THAT(warned("", "[[walls]]\nfrom = [9.0, 9.0]\nto = [11.0, 9.0]\nrestitution = 0.5\n"),
              testing::ElementsAre(HasSubstr("walls.0.restitution: Brownian disks")));
  EXPECT_THAT(warned("", "[[walls]]\nfrom = [9.0, 9.0]\nto = [11.0, 9.0]\n",
                     {{"box.wall_restitution", "0.5"},
                      {"box.left", "periodic"},
                      {"box.right", "periodic"},
                      {"box.bottom", "periodic"},
                      {"box.top", "periodic"}}),
              testing::ElementsAre(HasSubstr("box.wall_restitution: Brownian disks")));
  // The restitutions of the sides do not tell whether that of the box is 0.5 or 1, so the sides are named.
  EXPECT_THAT(warned("", "", {{"box.left", "{ restitution = 0.5 }"}, {"box.top", "{ restitution = 0.5 }"}}),
              testing::ElementsAre(HasSubstr("toml: box.left.restitution, box.top.restitution: Brownian disks")));
  EXPECT_THAT(warned("", "",
                     {{"box.wall_restitution", "0.5"},
                      {"box.left", "{ restitution = 1.0 }"},
                      {"box.top", "{ restitution = 0.75 }"}}),
              testing::ElementsAre(HasSubstr(
                  "toml: box.right.restitution, box.bottom.restitution, box.top.restitution: Brownian disks")));
  EXPECT_THAT(warned("", "[[physics.pairs]]\ngroups = [\"a\", \"a\"]\nrestitution = 0.5\n", {{"disks.0.name", "a"}}),
              testing::ElementsAre(HasSubstr("physics.pairs: Brownian disks")));
  EXPECT_THAT(warned("gravity = 3.0\naccumulate = true\n", "", {{"disks.0.mass", "{ uniform = [1, 2] }"}}),
              testing::IsEmpty());
  EXPECT_THAT(warned("", "", {{"disks.0.mass", "{ from_radius = 3.0 }"}}),
              testing::ElementsAre(HasSubstr("disks.mass: Brownian disks have no velocities")));
  EXPECT_THAT(warned("", "[[sources]]\nregion = [5.0, 5.0, 9.0, 9.0]\nrate = 1.0\nradius = 0.1\nmass = 2.0\n"),
              testing::ElementsAre(HasSubstr("disks.mass: Brownian disks have no velocities")));
  EXPECT_THAT(warned("", "[[disks]]\ncount = 0\npositions = \"random\"\nradius = 0.1\nmass = 2.0\n"),
              testing::IsEmpty());
  EXPECT_THAT(
      warned("", "[analysis]\nwhat = [\"profile\", \"velocity_autocorrelation\", \"density\", \"collision_rate\"]\n"),
      testing::ElementsAre(HasSubstr("their number grows as 1 / sqrt(dt)"),
                           HasSubstr("temperature of the profile are those of u / dt"),
                           HasSubstr("autocorrelation is that")));
}

// A drift has no effect on disks whose displacements are drawn anew in each step; for velocities drawn around 0 this is
// intended.
TEST(BrownianWarnings, TellOfAForgottenDrift) {
  const auto warned = [](std::string_view physics, std::string_view group) {
    return scene_warnings(test::scene_from(fmt::format(R"(
[box]
width = 20.0
height = 20.0
[physics]
{}
[[disks]]
count = 0
positions = "random"
drift = [1.0, 0.0]
radius = 0.1
mass = 1.0
[[disks]]
count = 2
positions = "random"
radius = 0.1
mass = 1.0
{}
[run]
dt = 0.01
t_end = 1.0
)",
                                                       physics, group)));
  };
  constexpr std::string_view brownian = "diffusion = 0.5";
  constexpr std::string_view forgotten =
      "Brownian disks have no velocities, only a displacement u in each step: the velocities given here are forgotten "
      "in the first step, and the disks do not drift";
  EXPECT_THAT(warned(brownian, ""), testing::IsEmpty());
  EXPECT_THAT(warned(brownian, "velocities = { maxwell = 1.0 }"), testing::IsEmpty());
  EXPECT_THAT(warned(brownian, "velocities = [[0, 0], [0, 0]]"), testing::IsEmpty());
  EXPECT_THAT(warned(brownian, "drift = [0.0, -0.5]"),
              testing::ElementsAre(HasSubstr(fmt::format("disks.1.drift: {}", forgotten))));
  EXPECT_THAT(warned(brownian, "velocities = [[0, 0], [0.5, 0]]"),
              testing::ElementsAre(HasSubstr(fmt::format("disks.1.velocities: {}", forgotten))));
  EXPECT_THAT(warned("diffusion = 0.5\naccumulate = true", "drift = [0.5, 0.0]"), testing::IsEmpty());
  EXPECT_THAT(warned("", "drift = [0.5, 0.0]"), testing::IsEmpty());
  const auto source = [](std::string_view place, std::string_view law) {
    return fmt::format("[[sources]]\n{}\nrate = 1.0\nradius = 0.1\nmass = 1.0\nvelocities = {{ {} }}\n", place, law);
  };
  for (const char* law : {"maxwell = 1.0", "uniform = 2.0"}) {
    EXPECT_THAT(warned(brownian, source("side = \"left\"", law)),
                testing::ElementsAre(HasSubstr(fmt::format("sources.0.velocities: {}", forgotten))));
    EXPECT_THAT(warned(brownian, source("region = [5.0, 5.0, 9.0, 9.0]", law)), testing::IsEmpty());
    EXPECT_THAT(warned("", source("side = \"left\"", law)), testing::IsEmpty());
  }
  EXPECT_THAT(warned(brownian, source("side = \"left\"", "maxwell = 0.0")), testing::IsEmpty());
}

}  // namespace
}  // namespace carom
