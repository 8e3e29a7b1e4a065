// Piles on several ranks: disks that land, come to rest and bear loads, with the bits of one machine after every step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

using test::expect_bits;
using test::local_trace;
using test::RankThreads;

// What a pile of these disks in a box of this size is; restitution 0.5 where physics says nothing of it.
Scene pile(const std::string& box, const std::string& physics, const std::string& disks, double dt, int steps) {
  const std::string restitution = physics.find("restitution") == std::string::npos ? "restitution = 0.5\n" : "";
  return parse_scene("[box]\n" + box + "[physics]\ngravity = 1.0\n" + restitution + physics + disks +
                         fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n", dt, dt * steps),
                     "scene", "");
}

std::string random_disks(int count, const std::string& sizes) {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ maxwell = 0.1 }}\n{}", count,
                     sizes);
}

// From landing to rest: impacts, supports and pushing, in the thousands.
TEST(SlabPiles, HaveTheBitsWhileDisksLandAndComeToRest) {
  const struct {
    std::string box, physics, sizes;
  } scenes[] = {
      {"width = 16.0\nheight = 20.0\n", "", "radius = 0.5\nmass = 1.0\n"},
      {"width = 16.0\nheight = 20.0\n", "", "radius = { uniform = [0.3, 0.6] }\nmass = { uniform = [1, 20] }\n"},
      {"width = 16.0\nheight = 20.0\nleft = \"periodic\"\nright = \"periodic\"\nwall_restitution = 0.3\n",
       "restitution = 0.0\n", "radius = { uniform = [0.2, 0.6] }\nmass = { from_radius = 1.0 }\n"},
      {"width = 16.0\nheight = 20.0\n", "restitution = { viscoelastic = 0.15, least = 0.3 }\n",
       "radius = 0.45\nmass = { uniform = [1, 3] }\n"},
      {"width = 16.0\nheight = 20.0\n", "roughness = { tangential_restitution = 0.4, friction = 0.3, inertia = 0.4 }\n",
       "radius = 0.5\nmass = 1.0\n"},
  };
  for (const auto& [box, physics, sizes] : scenes) {
    SCOPED_TRACE(sizes + physics);
    const Counters counters =
        expect_bits(pile(box, physics, random_disks(200, sizes), 0.02, 500), {1, 2, 3, 4}, RankThreads::alternate)
            .counters;
    EXPECT_GT(counters.collisions, 100U);
    EXPECT_GT(counters.wall_collisions, 20U);
  }
}

// Along x too, so that the pile leans on a side and loads go across many borders.
TEST(SlabPiles, HaveTheBitsUnderTiltedGravityAmongObstacles) {
  const Scene scene = pile("width = 14.0\nheight = 20.0\n", "",
                           random_disks(180, "radius = { uniform = [0.3, 0.6] }\nmass = 1.0\n") +
                               "[[disks]]\nfixed = true\ncount = 9\npositions = \"random\"\nradius = { uniform = [0.2, "
                               "0.8] }\n[[walls]]\npoints = [[2.0, 6.0], [6.0, 5.0], [9.0, 7.0]]\n",
                           0.02, 500);
  Scene tilted = scene;
  tilted.physics.gravity = Gravity(0.8, 0.6);
  for (const Scene& each : {scene, tilted}) {
    EXPECT_GT(expect_bits(each, {2, 3, 4}, RankThreads::alternate).counters.collisions, 100U);
  }
}

}  // namespace
}  // namespace carom
