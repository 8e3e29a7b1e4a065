// The number of disks taken by each sink, in every method, in the reference and the engine. Their agreement in random
// scenes, on any number of threads and ranks, and after resuming, is tested where counters are compared.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/load/scene_file.hpp"
#include "core/scene/scene_sinks.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/same_counters.hpp"

namespace carom {
namespace {

using ::testing::ElementsAre;

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

std::string segment(const std::string& points, const std::string& kind) {
  return fmt::format("[[walls]]\npoints = [{}]\nkind = \"{}\"\n", points, kind);
}

State by_engine(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

TEST(SinkCounts, AreThoseOfTheSinkAsked) {
  State state;
  EXPECT_EQ(taken_by({0, "left"}, state), 0U) << "no sink has taken a disk";
  state.taken = {1, 2, 3};
  EXPECT_EQ(taken_by({0, "left"}, state), 1U);
  EXPECT_EQ(taken_by({2, "bottom"}, state), 3U);
  EXPECT_EQ(taken_by({3, "top"}, state), 0U);
}

// The left side and two of three pockets, of which the last has two segments; no disk reaches the middle one. Pockets
// have the numbers of their tables, with walls counted.
TEST(SinkCounts, EachHasThoseThatItTook) {
  const std::string walls = segment("[1, 1], [2, 1]", "wall") + segment("[10, 2], [10, 4]", "sink") +
                            segment("[12, 2], [12, 4]", "sink") + segment("[10, 6], [10, 8], [10, 10]", "sink");
  for (const char* method : methods) {
    const Scene scene =
        parse_scene("[box]\nwidth = 20\nheight = 20\nleft = \"sink\"\n" + walls +
                        "[[disks]]\ncount = 4\npositions = [[5, 3], [5, 7], [5, 9], [5, 18]]\n"
                        "velocities = [[2, 0], [2, 0], [2, 0], [-2, 0]]\nradius = 0.5\nmass = 1\n[run]\nmethod = \"" +
                        method + "\"\ndt = 0.001\nt_end = 3\n",
                    "sinks.toml", "");
    EXPECT_THAT(test::run(scene, initial_state(scene)).taken, ElementsAre(1, 0, 0, 0, 0, 1, 0, 2)) << method;
    EXPECT_THAT(by_engine(scene).taken, ElementsAre(1, 0, 0, 0, 0, 1, 0, 2)) << method;
  }
}

// In time stepping the order of contacts within a step is not known: sides come first, then tables in their order.
TEST(SinkCounts, OfTwoSinksTouchedAtOnceTheFirstTakesTheDisk) {
  for (const char* method : {"pairwise", "rollback"}) {
    const Scene scene =
        parse_scene("[box]\nwidth = 20\nheight = 20\nbottom = \"sink\"\n" + segment("[5, 4], [5, 6]", "sink") +
                        segment("[5, 2], [5, 5]", "sink") +
                        "[[disks]]\ncount = 2\npositions = [[5, 0.5], [4.4, 5]]\nvelocities = [[0, 0], [2, 0]]\n"
                        "radius = 0.5\nmass = 1\n[run]\nmethod = \"" +
                        method + "\"\ndt = 0.01\nt_end = 0.1\n",
                    "sinks.toml", "");
    EXPECT_THAT(test::run(scene, initial_state(scene)).taken, ElementsAre(0, 0, 1, 0, 1, 0)) << method;
    EXPECT_THAT(by_engine(scene).taken, ElementsAre(0, 0, 1, 0, 1, 0)) << method;
  }
}

// Brownian disks that cross a side within an interval are counted for that side.
TEST(SinkCounts, BrownianDisksThatCrossASideUnseen) {
  for (const char* method : methods) {
    const Scene scene = parse_scene(
        fmt::format(
            "seed = 3\n[box]\nwidth = 20\nheight = 10\nleft = \"sink\"\ntop = \"sink\"\n[physics]\ndiffusion = 1\n"
            "[[disks]]\ncount = 60\nradius = 0.1\nmass = 1\npositions = \"random\"\n"
            "[run]\nmethod = \"{}\"\ndt = 0.5\nt_end = 20\n",
            method),
        "sinks.toml", "");
    const State end = test::run(scene, initial_state(scene));
    EXPECT_GT(end.taken[sink_number(Side::left)], 5U) << method;
    EXPECT_GT(end.taken[sink_number(Side::top)], 5U) << method;
    EXPECT_EQ(test::all_taken(end.taken), end.counters.removed) << method;
    EXPECT_EQ(by_engine(scene).taken, end.taken) << method;
  }
}

TEST(SinkCounts, WithoutSinksThereAreNone) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 20\n[[disks]]\ncount = 1\npositions = \"random\"\nradius = 0.5\nmass = 1\n[run]\ndt "
      "= 0.1\nt_end = 1\n",
      "gas.toml", "");
  EXPECT_TRUE(by_engine(scene).taken.empty());
}

}  // namespace
}  // namespace carom
