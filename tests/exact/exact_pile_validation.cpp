// Production B and C run to their end with the exact method: with the TC model the pile stands, although every disk in
// it collides for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/silo.hpp"

namespace carom::exact_tests {
namespace {

double lift_of(const Counters& c) {
  return c.wall_impulse[static_cast<std::size_t>(Side::bottom)] - c.wall_impulse[static_cast<std::size_t>(Side::top)];
}

// With contact_time 1e-2 a disk falls by at most 1e-4 of its radius in that time, and at rest there are ten times fewer
// collisions than with 1e-3 (docs/methods.md has the figures of both). The bound on the kinetic energy is that of the
// pairwise method's pile; the model itself leaves about m (g t_c)^2 / 32 per disk. The mean force on the floor over the
// last fifth of the run must be the weight.
void expect_to_settle(const char* file) {
  const Scene scene =
      load_scene(std::string(CAROM_SOURCE_DIR "/scenes/") + file,
                 {{"run.method", "exact"}, {"physics.collapse", "{ model = \"tc\", contact_time = 1e-2 }"}});
  const State start = initial_state(scene);
  const double g = scene.physics.gravity.down;
  const double energy = energy_of(start.disks, g).total();
  const double weight = test::weight_of(start.disks, g);
  const auto engine = make_parallel_engine(scene, start, {1, 1});
  double overlap = 0.0;
  double wall = 0.0;
  double gained = -HUGE_VAL;
  const auto run_until = [&](double t) {
    while (engine->state().time < t) {
      engine->step();
      const Disks& d = engine->state().disks;
      overlap = std::max(overlap, max_overlap(d, scene.box));
      wall = std::max(wall, wall_overlap(d, scene.box));
      gained = std::max(gained, energy_of(d, g).total() / energy - 1.0);
    }
  };
  run_until(0.8 * scene.run.t_end);
  const double since = engine->state().time;
  const double lift = lift_of(engine->state().counters);
  run_until(scene.run.t_end);
  const State& end = engine->state();
  const double force = (lift_of(end.counters) - lift) / (end.time - since);
  const double kinetic = energy_of(end.disks, g).kinetic / energy;
  std::printf(
      "%s, exact: kinetic at the end %.3g of the start's energy, overlap %.3g, below a wall %.3g, gained %.3g, "
      "force on the floor over weight %.5f, %.3g collisions\n",
      file, kinetic, overlap, wall, gained, force / weight, static_cast<double>(end.counters.collisions));
  EXPECT_LT(kinetic, 1e-6);
  EXPECT_LT(overlap, 1e-13);
  EXPECT_LT(wall, 1e-13);
  EXPECT_LE(gained, 1e-9);
  EXPECT_NEAR(force / weight, 1.0, 1e-3);
  EXPECT_EQ(end.disks.size(), start.disks.size());
}

TEST(ExactPile, ProductionBComesToRest) {
  expect_to_settle("production_b.toml");
}

TEST(ExactPile, ProductionCComesToRest) {
  expect_to_settle("production_c.toml");
}

}  // namespace
}  // namespace carom::exact_tests
