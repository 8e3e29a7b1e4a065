// Long runs of the exact method among fixed disks: no overlap after a million contacts, energy kept, and the bits of
// the reference.
#include <gtest/gtest.h>

#include "core/disks/obstacle_cells.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"

namespace carom {
namespace {

Scene among_pegs(const std::string& sides, double gravity) {
  return parse_scene(
      "[box]\nwidth = 40.0\nheight = 40.0\n" + sides + "[physics]\ngravity = " + std::to_string(gravity) +
          "\n[[disks]]\nfixed = true\ncount = 300\npositions = \"random\"\nradius = { uniform = [0.05, 0.8] }\n"
          "[[disks]]\ncount = 300\npositions = \"random\"\nvelocities = { uniform = 3.0 }\n"
          "radius = { uniform = [0.1, 0.4] }\nmass = { uniform = [1.0, 5.0] }\n"
          "[run]\nmethod = \"exact\"\nt_end = 1e9\n",
      "pegs.toml", "");
}

class AmongPegs : public ::testing::TestWithParam<double> {};

TEST_P(AmongPegs, NoOverlapAfterAMillionContacts) {
  const std::string periodic = "left = \"periodic\"\nright = \"periodic\"\n";
  const Scene scene = among_pegs(periodic, GetParam());
  const State start = initial_state(scene);
  Domain box = scene.box;
  const auto cells = place_obstacles(start.obstacles, box);
  const auto engine = make_parallel_engine(scene, start, {2, 64});
  double deepest = 0.0;
  for (Count k = 0; engine->state().counters.wall_collisions < 1'000'000; ++k) {
    engine->step();
    if (k % 16 != 0) continue;
    deepest = std::max({deepest, wall_overlap(engine->state().disks, box), max_overlap(engine->state().disks, box)});
  }
  EXPECT_LT(deepest, 1e-12);
  const double before = energy_of(start.disks, GetParam()).total();
  EXPECT_NEAR(energy_of(engine->state().disks, GetParam()).total(), before, 1e-9 * before);
}

TEST_P(AmongPegs, ReferenceAfterManyContacts) {
  const Scene scene = among_pegs("", GetParam());
  const State start = initial_state(scene);
  const auto reference = make_reference_engine(scene, start);
  const auto engine = make_parallel_engine(scene, start, {3, 256});
  while (reference->state().counters.wall_collisions < 200'000) {
    reference->step();
    engine->step();
    ASSERT_EQ(state_hash(reference->state().disks), state_hash(engine->state().disks)) << reference->state().time;
  }
}

INSTANTIATE_TEST_SUITE_P(Gravity, AmongPegs, ::testing::Values(0.0, 1.0));

}  // namespace
}  // namespace carom
