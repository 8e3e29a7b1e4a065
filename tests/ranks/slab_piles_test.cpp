// Piles on several ranks: disks that land, come to rest and bear loads, with the bits of a single machine after every
// step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/load/scene_file.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

using test::expect_bits;
using test::light_between_heavy;
using test::local_trace;
using test::RankThreads;

// A pile of these disks in a box of this size; restitution 0.5 unless `physics` gives another.
Scene pile(const std::string& box, const std::string& physics, const std::string& disks, double dt, int steps) {
  const std::string gravity = physics.find("gravity") == std::string::npos ? "gravity = 4.0\n" : "";
  const std::string restitution = physics.find("restitution") == std::string::npos ? "restitution = 0.5\n" : "";
  return parse_scene("[box]\n" + box + "[physics]\n" + gravity + restitution + physics + disks +
                         fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n", dt, dt * steps),
                     "scene", "");
}

std::string random_disks(int count, const std::string& sizes) {
  return fmt::format("[[disks]]\ncount = {}\npositions = \"random\"\nvelocities = {{ maxwell = 0.1 }}\n{}", count,
                     sizes);
}

// From landing to rest: impacts, supports and pushing apart.
struct Landing {
  const char *name, *box, *physics, *sizes;
};

class SlabPilesLanding : public ::testing::TestWithParam<Landing> {};

TEST_P(SlabPilesLanding, HasTheBitsUntilDisksRest) {
  const auto& [name, box, physics, sizes] = GetParam();
  const Scene scene =
      pile(std::string("width = 16.0\nheight = 16.0\n") + box, physics, random_disks(160, sizes), 0.01, 300);
  const Counters counters = expect_bits(scene, {1, 2, 3, 4}, RankThreads::alternate).counters;
  EXPECT_GT(counters.collisions, 50U);
  EXPECT_GT(counters.wall_collisions, 20U);
}

std::string name_of(const ::testing::TestParamInfo<Landing>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Disks, SlabPilesLanding,
                         ::testing::Values(Landing{"tilted", "", "gravity = [3.0, -2.0]\n",
                                                   "radius = { uniform = [0.3, 0.6] }\nmass = 1.0\n"}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(
    LongDisks, SlabPilesLanding,
    ::testing::Values(Landing{"equal", "", "", "radius = 0.5\nmass = 1.0\n"},
                      Landing{"mixed", "", "", "radius = { uniform = [0.3, 0.6] }\nmass = { uniform = [1, 20] }\n"},
                      Landing{"periodic_x", "left = \"periodic\"\nright = \"periodic\"\nwall_restitution = 0.3\n",
                              "restitution = 0.0\n",
                              "radius = { uniform = [0.2, 0.6] }\nmass = { from_radius = 1.0 }\n"},
                      Landing{"viscoelastic", "", "restitution = { viscoelastic = 0.15, least = 0.3 }\n",
                              "radius = 0.45\nmass = { uniform = [1, 3] }\n"},
                      Landing{"rough", "",
                              "roughness = { tangential_restitution = 0.4, friction = 0.3, inertia = 0.4 }\n",
                              "radius = 0.5\nmass = 1.0\n"},
                      Landing{"thermal", "left = { temperature = 2.0 }\nbottom = { temperature = 0.5 }\n", "",
                              "radius = 0.5\nmass = 1.0\n"}),
    name_of);

TEST(LongSlabPiles, HaveTheBitsAmongObstacles) {
  const Scene scene = pile("width = 14.0\nheight = 18.0\n", "",
                           random_disks(120, "radius = { uniform = [0.3, 0.6] }\nmass = 1.0\n") +
                               "[[disks]]\nfixed = true\ncount = 9\npositions = \"random\"\nradius = { uniform = [0.2, "
                               "0.8] }\n[[walls]]\npoints = [[2.0, 6.0], [6.0, 5.0], [9.0, 7.0]]\n",
                           0.01, 300);
  EXPECT_GT(expect_bits(scene, {2, 3, 4}, RankThreads::alternate).counters.collisions, 100U);
}

// Disks are poured in through the top and drain through a hole: slabs are cut anew, and loads move from rank to rank.
TEST(SlabPiles, HaveTheBitsWhileTheyArePouredAndDrained) {
  const Scene scene =
      pile("width = 12.0\nheight = 30.0\n", "",
           "[[sources]]\nregion = [1.0, 24.0, 11.0, 29.0]\nrate = 60.0\nradius = { uniform = [0.3, "
           "0.5] }\nmass = { from_radius = 1.0 }\n[[walls]]\nfrom = [4.0, 0.05]\nto = [7.0, 0.05]\nkind "
           "= \"sink\"\n",
           0.01, 450);
  std::size_t most = 0;
  const Counters counters = expect_bits(scene, {3, 4}, RankThreads::alternate, [&](const test::SlabTrace& trace) {
                              most = std::max(most, trace.last_disks);
                            }).counters;
  EXPECT_GT(counters.emitted, 100U);
  EXPECT_GT(counters.removed, 10U);
  EXPECT_GT(most, 20U);
}

// Ids in rows, in columns, and in columns of a lattice rotated by 90 degrees: along a border each contact waits for the
// one before, so there are many rounds.
TEST(LongSlabPiles, HaveTheBitsWhereIdsAreInOrderOfPlaces) {
  const auto lattice = [](bool in_columns) {
    std::string places;
    const int columns = 12;
    const int rows = 14;
    for (int k = 0; k < columns * rows; ++k) {
      const int column = in_columns ? k / rows : k % columns;
      const int row = in_columns ? k % rows : k / columns;
      places += fmt::format("[{}, {}], ", 0.5 + column * 1.0 + (row % 2 == 0 ? 0.0 : 0.5), 0.5 + row * 0.8661);
    }
    return fmt::format("[[disks]]\ncount = {}\npositions = [{}]\nradius = 0.5\nmass = 1.0\n", columns * rows, places);
  };
  for (const bool in_columns : {false, true}) {
    SCOPED_TRACE(in_columns);
    const Scene scene = pile("width = 12.6\nheight = 16.0\n", "", lattice(in_columns), 0.01, 80);
    expect_bits(scene, {2, 3, 4}, RankThreads::alternate);
  }
}

// Disks of one slab touch others below and above it.
TEST(LongSlabPiles, HaveTheBitsOnThinSlabs) {
  const Scene scene = pile("width = 8.0\nheight = 14.0\n", "gravity = [0.5, -4.0]\n",
                           random_disks(70, "radius = 0.43\nmass = { uniform = [1, 20] }\n"), 0.01, 300);
  EXPECT_GT(expect_bits(scene, {8}, RankThreads::alternate).counters.collisions, 50U);
}

// Light disks between heavy ones are sent far by impacts and by pushing, across up to eight slabs, and are pressed into
// others there.
TEST(LongSlabPiles, HaveTheBitsWhereDisksAreSentFar) {
  const Scene scene = pile("width = 24.0\nheight = 16.0\n", "gravity = 0.5\nrestitution = 0.9\n",
                           "[[disks]]\n" + light_between_heavy("1e-5"), 0.02, 15);
  EXPECT_GT(expect_bits(scene, {3, 8}, RankThreads::alternate).counters.collisions, 100U);
}

// A column of touching disks falls as one: at a border two of them have left their cells by exactly the largest
// distance.
TEST(SlabPiles, HaveTheBitsWhereAColumnThatTouchesFalls) {
  std::string places;
  std::string velocities;
  for (int k = 0; k < 20; ++k) {
    places += fmt::format("[1.5, {}], ", 5.5 + k);
    velocities += "[0.0254, -0.9047], ";
  }
  const Scene scene = pile(
      "width = 3.0\nheight = 30.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\n",
      "gravity = [0.01567, -0.006067]\nrestitution = 0.9\n",
      "[[disks]]\ncount = 20\npositions = [" + places + "]\nvelocities = [" + velocities +
          "]\n"
          "radius = 0.5\nmass = 1.0\n",
      0.35, 15);
  expect_bits(scene, {2, 3, 4}, RankThreads::alternate);
}

}  // namespace
}  // namespace carom
