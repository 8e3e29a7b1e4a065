// Disks that start from a frame of an earlier run: what is taken unchanged, and what is not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::replaced;
using testing::HasSubstr;
using testing::IsEmpty;

// A box of 20 x 10, three disks of radius 1 and mass 2.
std::string scene_with(const std::string& box, const std::string& physics, const std::string& disks,
                       const std::string& run = "t_end = 10.0\n") {
  return "[box]\nwidth = 20.0\nheight = 10.0\n" + box + "[physics]\n" + physics +
         "[[disks]]\ncount = 3\npositions = [[2, 2], [5, 5], [8, 2]]\nradius = 1.0\nmass = 2.0\n" + disks + "[run]\n" +
         run;
}

const std::string torus = "left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

// A frame is asked for velocities only if the scene takes them from it, and its shear flow is removed: of vx = g (y - h
// / 2), here 0.25 (y - 4), nothing is left.
TEST(FrameKeys, FramesGiveVelocitiesWithoutTheirFlow) {
  std::vector<bool> asked;
  const FrameReader frames = [&](const FrameAsked& frame) -> SceneFrame {
    asked.push_back(frame.velocities);
    SceneFrame found{{{2.0, 2.0}, {5.0, 5.0}, {8.0, 2.0}}, {{1.0, 0.5}, {2.0, 0.0}, {-1.0, 0.0}}, {}, {}};
    found.shear_rate = 0.25;
    found.height = 8.0;
    return found;
  };
  const std::string text = replaced(scene_with(torus + "shear_rate = 0.1\n", "", "velocities = { frame = \"out\" }\n"),
                                    "[[2, 2], [5, 5], [8, 2]]", "{ frame = \"out\" }");
  const Scene scene = parse_scene(text, "gas.toml", "", {}, frames);
  EXPECT_EQ(asked, (std::vector{false, true}));
  EXPECT_EQ(scene.groups[0].velocities.list, (std::vector<Vec2>{{1.5, 0.5}, {1.75, 0.0}, {-0.5, 0.0}}));
}

// Disks from a frame of time stepping, which overlap a little, may be scaled down; only radii are scaled.
TEST(FrameKeys, RadiiOfAFrameAreScaled) {
  const FrameReader frames = [](const FrameAsked&) -> SceneFrame {
    return {{{2.0, 2.0}, {5.0, 5.0}, {8.0, 2.0}}, {}, {0.5, 1.0, 2.0}, {1.0, 1.0, 4.0}};
  };
  const auto scene = [&](std::string_view radius, std::string_view mass) {
    const std::string text = replaced(scene_with("", "", ""), "radius = 1.0", fmt::format("radius = {}", radius));
    return parse_scene(replaced(text, "mass = 2.0", fmt::format("mass = {}", mass)), "gas.toml", "", {}, frames);
  };
  const std::string half = "{ frame = \"out\", scale = 0.5 }";
  const DiskGroup group = scene(half, "{ frame = \"out\" }").groups[0];
  EXPECT_EQ(group.radius.values, (std::vector{0.25, 0.5, 1.0}));
  EXPECT_EQ(group.mass.values, (std::vector{1.0, 1.0, 4.0}));
  try {
    scene("1.0", half);
    FAIL() << "the scene was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mass.scale: cannot be used for mass; expected it only for radius"));
  }
}

// The velocities u / dt of Brownian disks may be taken only for disks in Brownian motion, which are drawn anew.
TEST(FrameKeys, VelocitiesOfBrownianDisksServeBrownianDisks) {
  const FrameReader frames = [](const FrameAsked&) -> SceneFrame {
    SceneFrame found{{{2.0, 2.0}, {5.0, 5.0}, {8.0, 2.0}}, {{1.0, 0.5}, {2.0, 0.0}, {-1.0, 0.0}}, {}, {}};
    found.brownian = true;
    return found;
  };
  const auto complaint = [&](const std::string& physics) -> std::string {
    try {
      parse_scene(scene_with("", physics, "velocities = { frame = \"out\" }\n", "t_end = 1.0\ndt = 0.01\n"), "gas.toml",
                  "", {}, frames);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint("diffusion = 0.1\n"), IsEmpty());
  for (const char* const other : {"", "diffusion = 0.1\naccumulate = true\n"}) {
    EXPECT_THAT(complaint(other), HasSubstr("disks.0.velocities: are from out, whose Brownian disks")) << other;
  }
}

// Smooth disks of an earlier run have no spin.
TEST(FrameKeys, AFrameWithoutSpinsHasThemAtRest) {
  const FrameReader frames = [](const FrameAsked&) -> SceneFrame {
    return {{{2.0, 2.0}, {5.0, 5.0}, {8.0, 2.0}}, {}, {}, {}};
  };
  const Scene scene =
      parse_scene(scene_with("", "roughness = { tangential_restitution = 0.5 }\n", "spin = { frame = \"out\" }\n"),
                  "gas.toml", "", {}, frames);
  EXPECT_EQ(scene.groups[0].spins.list, (std::vector{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace carom
