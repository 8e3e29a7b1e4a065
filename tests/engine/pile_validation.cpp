// Production B and C run to their end: the pile stands, nothing sinks in, nothing overlaps, and no energy is gained.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

struct Worst {
  double overlap = 0.0;       // of two disks, over r1 + r2
  double below = 0.0;         // overlap with a wall, over the radius
  double gained = -HUGE_VAL;  // excess of the total energy over that of the start, relative to it
};

// Measured after every step.
void expect_to_settle(const char* file) {
  const Scene scene = load_scene(std::string(CAROM_SOURCE_DIR "/scenes/") + file);
  const State start = initial_state(scene);
  const double g = scene.physics.gravity.down;
  const double energy = energy_of(start.disks, g).total();
  Worst worst;
  const State end = test::run(scene, start, [&](const Engine& engine) {
    const Disks& d = engine.state().disks;
    worst.overlap = std::max(worst.overlap, max_overlap(d, scene.box));
    worst.below = std::max(worst.below, wall_overlap(d, scene.box));
    worst.gained = std::max(worst.gained, energy_of(d, g).total() / energy - 1.0);
  });
  const double kinetic = energy_of(end.disks, g).kinetic / energy;
  std::printf("%s: kinetic at the end %.3g of the start's energy, overlap %.3g, below a wall %.3g, gained %.3g\n", file,
              kinetic, worst.overlap, worst.below, worst.gained);
  EXPECT_LT(kinetic, 1e-6);
  EXPECT_LE(worst.overlap, 0.02);
  EXPECT_LE(worst.below, 0.01);
  EXPECT_LE(worst.gained, 1e-9);
  EXPECT_EQ(end.disks.size(), start.disks.size());
}

TEST(Pile, ProductionBComesToRest) {
  expect_to_settle("production_b.toml");
}

TEST(Pile, ProductionCComesToRest) {
  expect_to_settle("production_c.toml");
}

}  // namespace
}  // namespace carom
