// `exact` on several ranks: the bits of a single machine after every window, for any number of ranks and threads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

using test::expect_bits;
using test::Features;
using test::RankThreads;
using test::SlabTrace;

// A box so tall that each of four slabs is thicker than the part of it that depends on its neighbours.
struct TallBox {
  std::string sides = "periodic";
  double width = 24.0, height = 400.0;
  std::string box{};  // further keys
  int disks = 2000;
  std::string radius = "0.6", mass = "1.5";
  std::string positions = "random";
  double t_end = 8.0, step = 0.05;
  Features features{};  // physics
  std::string more{};   // obstacles, inner walls
};

Scene tall_scene(const TallBox& tall) {
  std::string sides = test::sides_text(tall.sides, 1);
  if (tall.sides == "turning") sides = "left = { motion = { vibrate = [0.2, 0.0], period = 0.6 } }\n";
  if (tall.sides == "moving") {
    sides =
        "left = { motion = { velocity = [0.3, 0.0] } }\nright = \"wall\"\ntop = \"wall\"\n"
        "bottom = { restitution = 0.9, motion = { vibrate = [0.0, 0.1], period = 0.17, shape = \"sine\" } }\n";
  }
  return parse_scene("[box]\n" + sides + fmt::format("width = {}\nheight = {}\n", tall.width, tall.height) + tall.box +
                         test::physics_text(tall.features) +
                         fmt::format("[[disks]]\ncount = {}\npositions = \"{}\"\nradius = {}\nmass = {}\n", tall.disks,
                                     tall.positions, tall.radius, tall.mass) +
                         "velocities = { maxwell = 4.0 }\n" +
                         (tall.features.rough.empty() ? "" : "spin_temperature = 5.0\n") + tall.more +
                         fmt::format("[run]\nmethod = \"exact\"\ndt = {}\nt_end = {}\n", tall.step, tall.t_end),
                     "scene", "");
}

// Compares the bits on 2, 3 and 4 ranks. sometimes_alone: rank 0 runs some windows alone, and slabs go on after them;
// otherwise no rank may ever have more than its share of the disks.
Counters expect_bits_on_slabs(const TallBox& tall, RankThreads threads = RankThreads::alternate,
                              bool sometimes_alone = false) {
  const auto all = static_cast<std::size_t>(tall.disks);
  std::size_t alone = 0;
  const auto see = [&](const SlabTrace& trace) {
    alone += trace.most_disks >= all ? 1 : 0;
    if (!sometimes_alone) {
      EXPECT_LT(trace.most_disks, 6 * all / 10);
      EXPECT_EQ(trace.thin, 0U);
    }
  };
  const Counters counters = expect_bits(tall_scene(tall), {2, 3, 4}, threads, see).counters;
  EXPECT_EQ(alone > 0, sometimes_alone);
  return counters;
}

TEST(LongSlabExact, HasTheBitsOfOneMachineAfterEveryWindow) {
  for (const char* sides : {"periodic", "wall", "soft", "hot"}) {
    SCOPED_TRACE(sides);
    EXPECT_GT(expect_bits_on_slabs({.sides = sides}, RankThreads::both).collisions, 5000U);
  }
}

TEST(LongSlabExact, HasTheBitsOfDenseAndDiluteGases) {
  for (const double packing_fraction : {0.05, 0.5, 0.7, 0.8}) {
    SCOPED_TRACE(packing_fraction);
    TallBox tall;
    tall.height = 2000.0 * 0.36 * 3.14159265 / 24.0 / packing_fraction;
    tall.positions = packing_fraction < 0.5 ? "random" : "hexagonal";
    tall.t_end = packing_fraction < 0.1 ? 15.0 : 4.0 * (1.0 - packing_fraction);
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
  }
}

TEST(LongSlabExact, HasTheBitsOfUnequalDisksThatLoseEnergy) {
  for (const char* law : {"", "viscoelastic"}) {
    TallBox tall{.radius = "{ uniform = [0.3, 1.1] }", .mass = "{ uniform = [1, 20] }"};
    tall.features.law = law;
    tall.features.restitution = 0.8;
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
    tall.box = "[physics.collapse]\nmodel = \"tc\"\ncontact_time = 1e-4\n";
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
  }
}

// The time of a disk's last collision, and its number of reflections by thermal sides, are known to every rank that
// sees the disk.
TEST(LongSlabExact, HasTheBitsOfDisksThatRememberTheirContacts) {
  for (const double width : {6.0, 10.0}) {
    TallBox tall{.sides = "hot", .width = width, .disks = static_cast<int>(90.0 * width), .t_end = 16.0};
    tall.features.restitution = 0.7;
    tall.box = "[physics.collapse]\nmodel = \"tc\"\ncontact_time = 0.1\n";
    EXPECT_GT(expect_bits_on_slabs(tall).wall_collisions, 2000U);
  }
}

// A side that vibrates in parabolas changes its motion at the end of a window: predictions become wrong on all ranks.
TEST(SlabExact, HasTheBitsOfASideThatTurns) {
  const TallBox tall{.sides = "turning", .width = 12.0, .disks = 1000, .t_end = 4.0};
  EXPECT_GT(expect_bits_on_slabs(tall).wall_collisions, 500U);
}

TEST(SlabExact, HasTheBitsOfRoughDisks) {
  for (const char* rough : {"sticking", "sliding"}) {
    TallBox tall{.sides = "wall"};
    tall.features.rough = rough;
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
  }
}

// The draws for a disk are the same on every rank that sees it.
TEST(SlabExact, HasTheBitsOfThermostatsAndBrownianMotion) {
  for (const char* thermostat : {"langevin", "andersen", ""}) {
    TallBox tall{.t_end = 3.0};
    tall.features.thermostat = thermostat;
    if (tall.features.thermostat.empty()) tall.features.diffusion = "replace";
    tall.step = 0.2;
    const Counters counters = expect_bits_on_slabs(tall);
    EXPECT_GT(counters.collisions, 1000U);
    EXPECT_EQ(counters.thermostat_heat != 0.0, !tall.features.thermostat.empty());
  }
}

// Sinks on sides and on inner walls take disks, and sources emit disks of sizes that no disk of the start has.
TEST(LongSlabExact, HasTheBitsOfSourcesAndSinks) {
  for (const bool sources : {false, true}) {
    for (const char* sides : {"sink", "periodic", "periodic_x"}) {
      SCOPED_TRACE(fmt::format("{} {}", sides, sources));
      TallBox tall{.sides = sides, .t_end = 4.0};
      tall.more = "[[walls]]\nfrom = [8.0, 60.0]\nto = [12.0, 330.0]\nkind = \"sink\"\n";
      if (sources) {
        tall.more +=
            "[[sources]]\nregion = [4.0, 50.0, 20.0, 350.0]\nrate = 20.0\nradius = { uniform = [0.1, 0.3] }\nmass = "
            "2.0\n"
            "velocities = { maxwell = 9.0 }\n";
      }
      const Counters counters = expect_bits_on_slabs(tall);
      EXPECT_GT(counters.collisions, 500U);
      EXPECT_GT(counters.removed, 30U);
      EXPECT_EQ(counters.emitted > 30U, sources);
    }
  }
}

// A box filled by sources: at first a single rank runs it.
TEST(LongSlabExact, HasTheBitsOfABoxThatSourcesFill) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 12.0\nheight = 300.0\ntop = \"sink\"\n[[sources]]\nregion = [1.0, 5.0, 11.0, 295.0]\nrate = "
      "300.0\n"
      "radius = { uniform = [0.2, 0.5] }\nmass = 1.0\nvelocities = { maxwell = 1.0 }\nlimit = 900\n"
      "[run]\nmethod = \"exact\"\nt_end = 5.0\n",
      "scene", "");
  std::size_t on_slabs = 0;
  const auto see = [&](const SlabTrace& trace) { on_slabs += trace.last_disks < 600 ? 1 : 0; };
  const Counters counters = expect_bits(scene, {2, 3}, RankThreads::alternate, see).counters;
  EXPECT_GT(on_slabs, 0U);
  EXPECT_EQ(counters.emitted, 900U);
}

// At times slabs are too thin, which is noticed after the sources have emitted what is due: one rank then runs the
// window without asking them again. The first of the two sources has a full corner.
TEST(SlabExact, AsksSourcesOnceWhereOneRankRunsTheWindow) {
  const Scene scene = parse_scene(
      "seed = 4\n[box]\nwidth = 30.0\nheight = 30.0\n[[disks]]\ncount = 12\npositions = \"square\"\nvelocities = { "
      "maxwell = 0.3 }\nradius = 0.5\nmass = 1.0\n"
      "[[sources]]\nregion = [1.0, 1.0, 6.0, 6.0]\nrate = 4.0\nradius = 0.5\nmass = 1.0\nvelocities = { maxwell = 0.1 "
      "}\n"
      "[[sources]]\nregion = [8.0, 8.0, 29.0, 29.0]\nrate = 4.0\nradius = 0.4\nmass = 1.0\nvelocities = { maxwell = "
      "0.1 }\n[run]\nmethod = \"exact\"\nt_end = 25.0\n",
      "scene", "");
  std::size_t thin = 0;
  const Counters counters =
      expect_bits(scene, {2, 3}, RankThreads::alternate, [&](const SlabTrace& t) { thin += t.thin; }).counters;
  EXPECT_GT(thin, 0U);
  EXPECT_GT(counters.waiting, 0U);
}

// An empty box has no common radius, as the first source draws radii. While one rank runs it, disks of the other
// sources bring a common radius, which all ranks must know when slabs go on.
TEST(SlabExact, KnowsTheRadiusThatNewcomersBringIntoAnEmptyBox) {
  std::string text =
      "[box]\nwidth = 12.0\nheight = 300.0\n[[sources]]\nregion = [1.0, 5.0, 11.0, 295.0]\nrate = 0.001\nradius = { "
      "uniform = [0.1, 0.2] }\nmass = 2.0\nvelocities = { maxwell = 1.0 }\n";
  for (int k = 0; k < 8; ++k) {
    text += fmt::format(
        "[[sources]]\nregion = [1.0, {}, 11.0, {}]\nrate = 300.0\nradius = 0.3\nmass = 2.0\nvelocities = {{ maxwell = "
        "1.0 }}\nlimit = 60\n",
        2 + 37 * k, 36 + 37 * k);
  }
  const Scene scene = parse_scene(text + "[run]\nmethod = \"exact\"\nt_end = 30.0\n", "scene", "");
  run_on_local_ranks(2, [&](Ranks& ranks) {
    const auto engine = make_slab_exact(scene, initial_state(scene), {1}, ranks);
    for (int step = 0; step < 3; ++step) engine->step();
    EXPECT_EQ(engine->progress().disks.common_radius, 0.3);
  });
  std::size_t on_slabs = 0;
  const auto see = [&](const SlabTrace& trace) { on_slabs += trace.last_disks < 320 ? 1 : 0; };
  EXPECT_GT(expect_bits(scene, {2, 3}, RankThreads::alternate, see).counters.collisions, 300U);
  EXPECT_GT(on_slabs, 0U);
}

// Brownian disks that cross a sink within an interval leave at the start of the next one.
TEST(SlabExact, HasTheBitsOfBrownianDisksThatSinksTake) {
  TallBox tall{.sides = "sink", .t_end = 3.0, .step = 0.2};
  tall.features.diffusion = "replace";
  EXPECT_GT(expect_bits_on_slabs(tall).removed, 30U);
}

// The disks fall, so slabs are cut anew during the run.
TEST(SlabExact, HasTheBitsUnderGravity) {
  for (const bool tilted : {false, true}) {
    TallBox tall{.sides = "wall", .t_end = 3.0};
    tall.features.gravity = true;
    tall.features.tilted = tilted;
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
  }
}

// A disk is put into the top side, as if a contact had been missed: all ranks report it, whichever has the disk.
TEST(SlabExact, SaysWhereADiskIsInAWall) {
  TallBox tall{.sides = "wall", .t_end = 0.1};
  tall.features.gravity = true;
  const Scene scene = tall_scene(tall);
  State start = initial_state(scene);
  Disks& d = start.disks;
  const auto highest = static_cast<std::size_t>(std::max_element(d.y.begin(), d.y.end()) - d.y.begin());
  d.y[highest] = scene.box.height - 0.3 * d.radius_of(highest);
  d.vx[highest] = d.vy[highest] = 0.0;
  const SlabTrace expected = test::one_machine_trace(scene, start);
  EXPECT_GT(expected.worst_wall.overlap.size, 0.1);
  EXPECT_EQ(expected.warnings.size(), 1U);
  run_on_local_ranks(3, [&](Ranks& ranks) { test::expect_same(expected, test::slab_trace(scene, start, {1}, ranks)); });
}

TEST(LongSlabExact, HasTheBitsWhereWallsMoveAndThingsStandInTheWay) {
  for (const char* sides : {"moving", "wall", "periodic"}) {
    SCOPED_TRACE(sides);
    TallBox tall{.sides = sides};
    tall.more =
        "[[disks]]\nfixed = true\ncount = 60\npositions = \"random\"\nregion = [4.0, 50.0, 24.0, 390.0]\n"
        "radius = { uniform = [0.05, 0.8] }\n[[walls]]\npoints = [[8.0, 20.0], [12.0, 130.0], [10.0, 250.0]]\n";
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
    tall.more =
        "[[walls]]\nfrom = [10.0, 190.0]\nto = [15.0, 205.0]\nmotion = { vibrate = [0.3, -0.2], period = 0.3 }\n";
    EXPECT_GT(expect_bits_on_slabs(tall).collisions, 3000U);
  }
}

// A disk with hardly any room between two fixed ones makes windows crowded.
TEST(LongSlabExact, HasTheBitsAfterCrowdedWindows) {
  TallBox tall{.t_end = 0.02};
  tall.box =
      "[[disks]]\nfixed = true\ncount = 2\npositions = [[5.0, 210.0], [5.0, 212.400005]]\nradius = 0.6\n"
      "[[disks]]\ncount = 1\npositions = [[5.0, 211.200002]]\nvelocities = [[0.0, 100.0]]\nradius = 0.6\nmass = 1.5\n";
  EXPECT_GT(expect_bits_on_slabs(tall, RankThreads::alternate, true).wall_collisions, 50'000U);
}

// Light disks among heavy ones soon exceed the speed bound, and become so fast that slabs are too thin.
TEST(SlabExact, HasTheBitsWhereWindowsAreDoneAgain) {
  const TallBox tall{.mass = "{ uniform = [1, 2000] }", .t_end = 150.0};
  EXPECT_GT(expect_bits_on_slabs(tall, RankThreads::alternate, true).collisions, 3000U);
}

// Scenes with features that slabs cannot handle are run by one rank.
TEST(LongSlabExact, HasTheBitsOfScenesThatOneRankRuns) {
  for (const char* sides : {"wall", "periodic", "sink", "periodic_x"}) {
    int k = 0;
    for (const Features& f : test::all_features("exact", sides)) {
      if (k++ % 3 != 0 || f.gravity || f.restitution < 1.0) continue;
      const Scene scene = test::feature_scene(f, 20);
      SCOPED_TRACE(scene.title);
      expect_bits(scene, {1, 3}, RankThreads::alternate);
    }
  }
}

}  // namespace
}  // namespace carom
