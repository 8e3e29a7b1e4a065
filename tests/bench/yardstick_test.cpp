// The yardstick of the benchmarks computes the same as the engine compared with it: a comparison with a program that is
// wrong, or does less, would mean nothing.
#include "bench/support/yardstick.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/support/interleave.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

Scene gas(int count, double packing_fraction, double t_end) {
  return parse_scene(fmt::format("[box]\npacking_fraction = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = "
                                 "\"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = {}\npositions = "
                                 "\"hexagonal\"\nvelocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n"
                                 "[run]\nmethod = \"exact\"\nt_end = {}\n",
                                 packing_fraction, count, t_end),
                     "test", ".");
}

// Within half the Lyapunov horizon of docs/reference_values.md (t = 21, 11, 6.8 at packing fractions 0.1, 0.3, 0.5)
// both follow the same trajectory: each has the collisions of the other, and disks are in the same places. The
// yardstick's times are absolute (rounding 1e-15 at t = 10), and errors grow by exp(lambda t) = 4e6, 9e6 and 1e7: hence
// the tolerance of 1e-5.
TEST(Yardstick, FollowsTheExactReference) {
  const double packing_fractions[] = {0.1, 0.3, 0.5};
  const double times[] = {10.0, 5.5, 3.4};
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(packing_fractions[k]);
    const Scene scene = gas(300, packing_fractions[k], times[k]);
    const State initial = initial_state(scene);
    const State expected = run_reference(scene, initial);
    bench::Yardstick yardstick(initial.disks, scene.box);
    yardstick.run_until(times[k]);
    EXPECT_EQ(yardstick.collisions(), expected.counters.collisions);
    EXPECT_GT(expected.counters.collisions, 500U);
    Disks disks = initial.disks;
    yardstick.write_to(disks);
    double farthest = 0.0;
    for (std::size_t i = 0; i < disks.size(); ++i) {
      const std::size_t j = index_of(expected.disks, disks.id[i]);
      farthest = std::max({farthest, std::abs(nearest_image(disks.x[i] - expected.disks.x[j], scene.box.width)),
                           std::abs(nearest_image(disks.y[i] - expected.disks.y[j], scene.box.height))});
    }
    EXPECT_LT(farthest, 1e-5);
  }
}

TEST(Yardstick, CollisionsAreCountedFromWhereItIs) {
  const Scene scene = gas(100, 0.3, 1.0);
  bench::Yardstick yardstick(initial_state(scene).disks, scene.box);
  for (const Count all : {50U, 100U, 150U}) {
    const double before = yardstick.time();
    yardstick.run_collisions(50);
    EXPECT_EQ(yardstick.collisions(), all);
    EXPECT_GT(yardstick.time(), before);
  }
}

// After that, over 200 collisions per disk: the collision rate is 4 (Z - 1) / sqrt(pi) with Z(0.3) = 2.06326, to 1 %
// (the standard error of 2e5 collisions is a third of that), and the energy is constant to rounding.
TEST(Yardstick, KeepsTheRateAndTheEnergy) {
  const Scene scene = gas(1000, 0.3, 100.0);
  const State initial = initial_state(scene);
  bench::Yardstick yardstick(initial.disks, scene.box);
  yardstick.run_until(10.0);
  const Count before = yardstick.collisions();
  yardstick.run_until(100.0);
  const double rate = 2.0 * static_cast<double>(yardstick.collisions() - before) / (1000.0 * 90.0);
  EXPECT_NEAR(rate, 4.0 * 1.06326 / std::sqrt(std::numbers::pi), 0.024);
  Disks disks = initial.disks;
  yardstick.write_to(disks);
  EXPECT_NEAR(energy_of(disks, 0.0).kinetic / energy_of(initial.disks, 0.0).kinetic, 1.0, 1e-12);
  EXPECT_LT(max_overlap(disks, scene.box), 1e-12);
}

// For two rounds it was once the slower one.
TEST(Median, IsInTheMiddle) {
  EXPECT_EQ(bench::median({3.0}), 3.0);
  EXPECT_EQ(bench::median({4.0, 1.0}), 2.5);
  EXPECT_EQ(bench::median({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(bench::median({9.0, 2.0, 4.0, 1.0}), 3.0);
}

}  // namespace
}  // namespace carom::exact_tests
