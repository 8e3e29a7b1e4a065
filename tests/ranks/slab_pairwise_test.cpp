// `pairwise` on several ranks: the bits of a single machine after every step, for any number of ranks and threads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/slabs/slab_cut.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

using test::expect_bits;
using test::Features;
using test::local_trace;
using test::RankThreads;
using test::slab_scene;

constexpr int steps = 10;

class SlabPairwise : public ::testing::TestWithParam<const char*> {};

TEST_P(SlabPairwise, HasTheBitsOfOneMachineAfterEveryStep) {
  Count collisions = 0;
  const std::vector<Scene> scenes = test::slab_scenes(GetParam(), steps);
  ASSERT_GE(scenes.size(), 4U);
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(scene.title);
    collisions += expect_bits(scene, {1, 2, 3, 4}, RankThreads::alternate).counters.collisions;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(collisions, 25U * scenes.size());
}

std::string name_of(const ::testing::TestParamInfo<const char*>& info) {
  return info.param;
}

INSTANTIATE_TEST_SUITE_P(Sides, SlabPairwise, ::testing::Values("moving"), name_of);
INSTANTIATE_TEST_SUITE_P(LongSides, SlabPairwise,
                         ::testing::Values("wall", "periodic", "periodic_x", "soft", "sink", "hot"), name_of);

// Nearly all disks are in contact after each step, so clusters extend through whole slabs.
TEST(SlabPairwiseRun, HasTheBitsWhereClustersReachThroughSlabs) {
  const Scene scene = slab_scene("periodic", "packing_fraction = 0.82\n",
                                 "count = 600\npositions = \"hexagonal\"\nradius = 0.5\nmass = 1.0\n"
                                 "velocities = { maxwell = 1.0 }\n",
                                 0.06, 60);
  EXPECT_GT(expect_bits(scene, {2, 3, 4}).counters.collisions, 5'000U);
}

// A column of touching disks from floor to ceiling is one cluster through all slabs; an impulse at one end comes out at
// the other.
TEST(SlabPairwiseRun, HasTheBitsWhereOneClusterIsAllSlabs) {
  std::string places;
  std::string velocities;
  for (int k = 0; k < 24; ++k) {
    places += fmt::format("[3.0, {}], ", 0.5 + k);
    velocities += fmt::format("[{}, {}], ", 0.01 * (k % 5), k == 0 ? 3.0 : -0.1);
  }
  const Scene scene = slab_scene(
      "wall", "width = 6.0\nheight = 24.0\n",
      "count = 24\npositions = [" + places + "]\nvelocities = [" + velocities + "]\nradius = 0.5\nmass = 1.0\n", 0.05,
      100);
  EXPECT_GT(expect_bits(scene, {2, 3, 4}).counters.collisions, 50U);
}

// Disks that stick together after a head-on collision: a single contact is resolved once, even if by rounding it still
// seems to approach. All disks meet across the border of two slabs.
TEST(SlabPairwiseRun, ResolvesAContactThatIsAloneOnce) {
  std::string places;
  std::string velocities;
  for (int k = 0; k < 60; ++k) {
    places += fmt::format("[{0}, 9.3], [{1}, 10.7], ", 1.0 + 2 * k, 1.0 + 2 * k + 0.01 * (k % 7));
    velocities += fmt::format("[0.0, {}], [0.0, {}], ", 0.9 + 0.037 * k, -0.3 - 0.011 * k);
  }
  const Scene scene = slab_scene(
      "wall", "width = 121.0\nheight = 20.0\n[physics]\nrestitution = 0.0\n",
      "count = 120\npositions = [" + places + "]\nvelocities = [" + velocities + "]\nradius = 0.5\nmass = 1.0\n", 0.03,
      20);
  EXPECT_GE(expect_bits(scene, {2, 3}).counters.collisions, 60U);
}

// Impacts send light disks between heavy ones further than the room beyond thin slabs, and past whole slabs, since a
// step is not split because of its own impacts.
TEST(SlabPairwiseRun, HasTheBitsWhereImpactsSendDisksFar) {
  for (const double height : {16.7, 21.6}) {
    SCOPED_TRACE(height);
    const Scene scene = slab_scene("wall", fmt::format("width = 24.0\nheight = {}\n", height),
                                   test::light_between_heavy("1e-5"), 0.05, 15);
    EXPECT_GT(expect_bits(scene, {3, 8}, RankThreads::alternate).counters.collisions, 100U);
  }
}

// A light disk below each border flies up to a disk at rest above it, in a box of heavy disks at rest: too few disks
// leave their cells for a new sort, so those at the border are strays.
TEST(SlabPairwiseRun, HasTheBitsWhereFewDisksLeaveTheirCells) {
  std::string places;
  std::string velocities;
  std::string masses;
  const auto add = [&](double x, double y, double vy, const char* mass) {
    places += fmt::format("[{}, {}], ", x, y);
    velocities += fmt::format("[0.0, {}], ", vy);
    masses += fmt::format("{}, ", mass);
  };
  for (int k = 0; k < 1600; ++k) add(1.5 + 3.0 * (k % 20), 1.5 + 3.0 * (k / 20), 0.0, "1.0");
  // The borders for two slabs and for three.
  int lane = 0;
  for (const double border : {121.5, 79.5, 160.5}) {
    add(9.0 + 12.0 * lane, border + 0.3, 0.0, "1.0");
    add(9.0 + 12.0 * lane++, border - 12.0, 2.0, "1e-3");
  }
  const Scene scene = slab_scene("periodic", "width = 60.0\nheight = 240.0\n",
                                 "count = 1606\npositions = [" + places + "]\nvelocities = [" + velocities +
                                     "]\nradius = 0.5\nmass = [" + masses + "]\n",
                                 0.1, 100);
  EXPECT_GE(expect_bits(scene, {2, 3}, RankThreads::alternate).counters.collisions, 3U);
}

// The box is filled from one side with disks of sizes that no disk of the start has, and sinks take them.
TEST(LongSlabPairwiseRun, HasTheBitsWhereSourcesFillAnEmptyBox) {
  for (const char* radius : {"0.4", "{ uniform = [0.2, 0.5] }"}) {
    const Scene scene =
        parse_scene(fmt::format("[box]\nwidth = 12.0\nheight = 24.0\ntop = \"sink\"\n"
                                "[[sources]]\nside = \"bottom\"\nrate = 40.0\nradius = {0}\nmass = 1.0\n"
                                "velocities = {{ maxwell = 9.0 }}\n"
                                "[[sources]]\nregion = [2.0, 4.0, 10.0, 14.0]\nrate = 7.0\nradius = 0.3\n"
                                "mass = {{ uniform = [1, 3] }}\n[run]\nmethod = \"pairwise\"\ndt = 0.02\nt_end = 5.0\n",
                                radius),
                    "scene", "");
    const Counters counters = expect_bits(scene, {1, 2, 3, 4}, RankThreads::alternate).counters;
    EXPECT_GT(counters.emitted, 100U);
    EXPECT_GT(counters.collisions, 100U);
    EXPECT_GT(counters.removed, 5U);
  }
}

// Strains of several units: the upper images go around the box, and disks cross from the last slab into the first.
TEST(LongSlabPairwiseRun, HasTheBitsOfAShearFlow) {
  Scene scene = slab_scene("periodic", "width = 20.0\nheight = 20.0\nshear_rate = 0.7\n",
                           "count = 220\npositions = \"random\"\nradius = { uniform = [0.4, 0.5] }\nmass = 1.0\n"
                           "velocities = { maxwell = 1.0 }\n",
                           0.02, 300);
  for (const bool rough : {false, true}) {
    if (rough) {
      scene.physics.surfaces.disks = {0.5, 0.3};
      scene.physics.surfaces.inertia = 0.5;
    }
    ASSERT_EQ(initial_state(scene).disks.spins(), rough);
    const Counters counters = expect_bits(scene, {1, 2, 3, 4}, RankThreads::alternate).counters;
    EXPECT_GT(counters.collisions, 1000U);
    EXPECT_NE(counters.shear_work, 0.0);
  }
}

// Reflections are counted for each disk: one that moves to another slab takes its count along.
TEST(SlabPairwiseRun, HasTheBitsBetweenThermalSides) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 12.0\nheight = 24.0\nbottom = { temperature = 9.0 }\ntop = { temperature = 0.5 }\n"
      "left = { temperature = 2.0 }\n[[disks]]\ncount = 120\npositions = \"random\"\nradius = 0.5\nmass = 1.0\n"
      "velocities = { maxwell = 4.0 }\n[run]\nmethod = \"pairwise\"\ndt = 0.02\nt_end = 8.0\n",
      "scene", "");
  const State start = initial_state(scene);
  const Counters counters = expect_bits(scene, {1, 2, 3, 4}, RankThreads::alternate).counters;
  EXPECT_GT(counters.wall_collisions, 300U);
  EXPECT_GT(local_trace(scene, start, {1, 1}, 4).most_moved, 0U);
}

// Steps are split in the same way on all ranks, after kicks that make disks faster, after fast or small newcomers, and
// after sinks that take the smallest.
TEST(SlabPairwiseRun, SplitsStepsAsOneMachineDoes) {
  const auto scene = [](const std::string& box, const std::string& physics, const std::string& disks,
                        const std::string& end) {
    return parse_scene("seed = 4427\n[box]\n" + box + "[physics]\n" + physics +
                           "[[disks]]\npositions = \"random\"\nmass = 1.0\n" + disks +
                           "[run]\nmethod = \"pairwise\"\n" + end,
                       "split.toml", "");
  };
  const std::string around = "left = \"periodic\"\nright = \"periodic\"\n";
  const std::string square = "width = 20.0\nheight = 16.0\n" + around;
  const Scene kicked =
      scene(square, "thermostat = { kind = \"langevin\", temperature = 9.0, rate = 0.05, dt = 0.25 }\n",
            "count = 120\nradius = 0.4\nvelocities = { maxwell = 0.1 }\n", "dt = 0.05\nt_end = 5.0\n");
  const Scene emitted = scene(
      square, "",
      "count = 60\nradius = 0.5\nvelocities = { maxwell = 1.0 }\n[[sources]]\nregion = [2, 2, 18, 14]\nrate = 20.0\n"
      "radius = { uniform = [0.15, 0.5] }\nmass = 1.0\nvelocities = { maxwell = 20.0 }\n",
      "dt = 0.03\nt_end = 3.0\n");
  const Scene taken =
      scene("width = 38.63\nheight = 77.26\nbottom = \"sink\"\n" + around, "gravity = 0.1\nrestitution = 0.5\n",
            "count = 30\nradius = { uniform = [0.75498, 3.01992] }\nvelocities = { maxwell = 1.0 }\n",
            "dt = 0.50332\nt_end = 50.332\n");
  for (const Scene& each : {kicked, emitted, taken}) {
    const test::SlabTrace trace = expect_bits(each, {2, 3}, RankThreads::alternate);
    EXPECT_GT(trace.counters.collisions, 5U);
    EXPECT_FALSE(trace.warnings.empty()) << "split steps must be warned of";
  }
}

// The lowest disk touches the sink at the start, and another would hit it within the first step.
TEST(SlabPairwiseRun, TakesWhatTouchesASinkBeforeTheFirstStep) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 6.0\nheight = 24.0\nbottom = \"sink\"\n[[disks]]\ncount = 4\n"
      "positions = [[3.0, 0.5], [3.0, 1.55], [3.0, 8.0], [3.0, 20.0]]\n"
      "velocities = [[0.0, 0.0], [0.0, -1.0], [0.0, 0.5], [0.0, 0.0]]\nradius = 0.5\nmass = 1.0\n"
      "[run]\nmethod = \"pairwise\"\ndt = 0.1\nt_end = 0.3\n",
      "scene", "");
  const Counters counters = expect_bits(scene, {1, 2, 3}).counters;
  EXPECT_EQ(counters.removed, 1U);
  EXPECT_EQ(counters.collisions, 0U);
}

TEST(SlabPairwiseRun, HasTheBitsOfASceneWithoutDisks) {
  expect_bits(slab_scene("wall", "width = 3.0\nheight = 3.0\n",
                         "count = 0\npositions = \"random\"\nradius = 0.5\nmass = 1.0\n", 0.1, 3),
              {1, 3});
}

// A step refused on a single machine is refused with the same message on all ranks.
TEST(SlabPairwiseRun, EndsAsOneMachineWhereAStepIsFarTooLong) {
  const Scene scene = slab_scene("wall", "width = 30.0\nheight = 30.0\n",
                                 "count = 9\npositions = \"square\"\nradius = 0.5\nmass = 1.0\n"
                                 "velocities = { uniform = 1e6 }\n",
                                 1.0, 3);
  const State start = initial_state(scene);
  std::string expected;
  try {
    make_parallel_engine(scene, start, {1})->step();
  } catch (const PhysicsError& error) {
    expected = error.what();
  }
  ASSERT_NE(expected, "");
  run_on_local_ranks(3, [&](Ranks& ranks) {
    const auto engine = make_slab_pairwise(scene, start, {1}, ranks);
    try {
      engine->step();
      ADD_FAILURE() << "no exception";
    } catch (const PhysicsError& error) {
      EXPECT_EQ(error.what(), expected);
    }
  });
}

// A scene that slabs cannot handle is run by one rank, with the same bits and the reason.
void expect_one_rank(const Scene& scene, const std::string& why) {
  const State start = initial_state(scene);
  run_on_local_ranks(2, [&](Ranks& ranks) {
    EXPECT_EQ(make_slab_pairwise(scene, start, {1}, ranks)->take_warnings(),
              std::vector<std::string>{"one rank runs all disks: " + why});
  });
  expect_bits(scene, {2, 3}, RankThreads::alternate,
              [&](const test::SlabTrace& trace) { EXPECT_GE(trace.most_disks, start.disks.size()); });
}

TEST(SlabPairwiseAlone, RunsSlabsThinnerThanTwoDiametersOfTheLargestDisk) {
  Features f;
  f.radii = "wide";  // the largest radius is 4, and the box is 18 high
  const Scene scene = test::feature_scene(f, steps);
  const State start = initial_state(scene);
  run_on_local_ranks(
      1, [&](Ranks& ranks) { EXPECT_TRUE(make_slab_pairwise(scene, start, {1}, ranks)->take_warnings().empty()); });
  const std::string thin =
      " slabs of a box of height 18 would be thinner than two diameters of the largest disk, whose radius is 4; use at "
      "most 1";
  expect_one_rank(scene, "2" + thin);
}

TEST(SlabCut, HasAsManyDisksInEachSlab) {
  Disks disks;
  for (int k = 0; k < 1000; ++k) append(disks, {0.0, 0.03 * k, 0.0, 0.0, 0.1, 1.0, static_cast<DiskId>(k)});
  Domain box;
  box.width = 10.0;
  box.height = 100.0;
  const SlabCut cut = cut_into_slabs(box, disks, 4, 1.0);
  ASSERT_EQ(cut.ranks(), 4);
  EXPECT_EQ(cut.bounds, (std::vector<double>{0.0, 7.5, 15.0, 22.5, 100.0}));
  EXPECT_EQ(cut.rank_at(-1.0), 0);
  EXPECT_EQ(cut.rank_at(7.49), 0);
  EXPECT_EQ(cut.rank_at(7.5), 1);
  EXPECT_EQ(cut.rank_at(99.0), 3);
  EXPECT_EQ(cut.rank_at(101.0), 3);
  // No slab is thinner than necessary.
  const SlabCut thick = cut_into_slabs(box, disks, 4, 25.0);
  EXPECT_EQ(thick.bounds, (std::vector<double>{0.0, 25.0, 50.0, 75.0, 100.0}));
  EXPECT_EQ(thick.thinnest(), 25.0);
}

}  // namespace
}  // namespace carom
