// Conservation in whole runs of random scenes: momentum, energy, and the balance of forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/measure/invariants.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

constexpr test::Ranges mixed{0.5, 2.5, 1.0, 100.0, 2.0};  // radii 1 : 5, masses 1 to 100

class Conservation : public testing::TestWithParam<Method> {
 protected:
  static constexpr double side = 40.0;
  Scene scene(double dt, double t_end, bool periodic) const {
    Scene s = test::scene_of(GetParam(), side, side, dt, t_end);
    if (periodic) test::set_sides(s.box, SideKind::periodic, SideKind::periodic);
    return s;
  }
  // Odd seeds have a common radius and mass, so that runs with and without these columns are tested.
  static State start_of(const Scene& s, std::uint64_t seed) {
    test::Draws draws(seed);
    const test::Ranges equal{1.0, 1.0, 3.0, 3.0, 2.0};
    return test::state_of(s, test::random_disks(draws, s.box, 40, seed % 2 == 0 ? mixed : equal));
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Conservation, testing::ValuesIn(test::stepping_methods),
                         [](const auto& method) { return test::name_of(method.param); });

// In a periodic box only pairs exchange momentum: it is conserved to 1e-12 of the sum of |m v|, for any restitution.
TEST_P(Conservation, MomentumInAPeriodicBox) {
  for (const double e : {1.0, 0.6}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Scene s = scene(0.02, 10.0, true);
      s.physics.restitution = e;
      const State start = start_of(s, seed);
      const Momentum p = momentum_of(start.disks);
      double worst = 0.0;
      const State end = test::run(s, start, [&](const Engine& engine) {
        const Momentum now = momentum_of(engine.state().disks);
        worst = std::max({worst, std::abs(now.x - p.x) / p.magnitude, std::abs(now.y - p.y) / p.magnitude});
      });
      EXPECT_LE(worst, 1e-12);
      EXPECT_GT(end.counters.collisions, 30U);
    }
  }
}

// e = 1 without gravity: every collision conserves the energy to rounding, at walls, too, and with or without overlaps.
TEST_P(Conservation, EnergyOfElasticDisks) {
  for (const bool periodic : {false, true}) {
    for (std::uint64_t seed = 10; seed < 14; ++seed) {
      const Scene s = scene(0.02, 10.0, periodic);
      const State start = start_of(s, seed);
      const double energy = energy_of(start.disks, 0.0).total();
      double worst = 0.0;
      const State end = test::run(s, start, [&](const Engine& engine) {
        worst = std::max(worst, std::abs(energy_of(engine.state().disks, 0.0).total() / energy - 1.0));
      });
      EXPECT_LE(worst, 1e-12);
      EXPECT_GT(end.counters.collisions, 30U);
    }
  }
}

// e < 1: the total energy is never above that of the start by more than 1e-9 of it, and it falls.
TEST_P(Conservation, DissipatingDisksNeverGainEnergy) {
  for (const double g : {0.0, 0.5}) {
    for (std::uint64_t seed = 20; seed < 24; ++seed) {
      Scene s = scene(0.01, 10.0, false);
      s.physics.gravity = g;
      s.physics.restitution = 0.5;
      s.box.restitutions.fill(seed % 4 < 2 ? 1.0 : 0.5);
      const State start = start_of(s, seed);
      const double energy = energy_of(start.disks, g).total();
      double highest = -1.0;
      const State end = test::run(s, start, [&](const Engine& engine) {
        highest = std::max(highest, energy_of(engine.state().disks, g).total() / energy - 1.0);
      });
      EXPECT_LE(highest, 1e-9) << "g " << g << " seed " << seed;
      EXPECT_LT(energy_of(end.disks, g).total(), energy);
    }
  }
}

// e = 1 with gravity and elastic walls: the mean of |change of energy| over seeds shrinks at least linearly with dt.
TEST_P(Conservation, DriftUnderGravityShrinksWithTheStep) {
  constexpr std::uint64_t seeds = 12;
  const double longest = 0.04;
  double drift[3] = {};
  for (int k = 0; k < 3; ++k) {
    for (std::uint64_t seed = 30; seed < 30 + seeds; ++seed) {
      Scene s = scene(std::ldexp(longest, -k), 8.0, false);
      s.physics.gravity = 0.5;
      const State start = start_of(s, seed);
      const double energy = energy_of(start.disks, 0.5).total();
      const State end = test::run(s, start);
      drift[k] += std::abs(energy_of(end.disks, 0.5).total() / energy - 1.0) / seeds;
    }
  }
  std::printf("%s: drift of energy at dt, dt/2, dt/4: %.3g %.3g %.3g\n", test::name_of(GetParam()).c_str(), drift[0],
              drift[1], drift[2]);
  EXPECT_LE(drift[2], 0.25 * drift[0] + 1e-12);
  EXPECT_LE(drift[2], drift[1] + 1e-12);
}

// The floor's impulse minus the ceiling's is the impulse of gravity plus the change of momentum (N m g per time on
// average, at any density). Without gravity the same holds for left and right. This is exact, so every wall hit is
// accounted for.
TEST_P(Conservation, ForcesOnTheWallsBalance) {
  Scene s = scene(0.01, 10.0, false);
  s.physics.gravity = 0.5;
  for (std::uint64_t seed = 40; seed < 44; ++seed) {
    const State start = start_of(s, seed);
    const State end = test::run(s, start);
    const Momentum before = momentum_of(start.disks);
    const Momentum after = momentum_of(end.disks);
    double mass = 0.0;
    for (std::size_t i = 0; i < start.disks.size(); ++i) mass += start.disks.mass_of(i);
    const double* impulse = end.counters.wall_impulse;
    const double scale = impulse[0] + impulse[1] + impulse[2] + impulse[3];
    EXPECT_NEAR((impulse[2] - impulse[3] - mass * 0.5 * end.time - (after.y - before.y)) / scale, 0.0, 1e-12);
    EXPECT_NEAR((impulse[0] - impulse[1] - (after.x - before.x)) / scale, 0.0, 1e-12);
  }
}

// Clausius: sum m r.v changes by 2 K per time and by r.impulse in every collision, which the virial and the walls'
// impulses count.
TEST(ConservationExact, TheVirialTheoremHoldsToRounding) {
  constexpr double width = 40.0, height = 30.0, radius = 1.0;
  for (std::uint64_t seed = 40; seed < 43; ++seed) {
    const Scene s = test::scene_of(Method::exact, width, height, 0.0, 20.0);
    test::Draws draws(seed);
    const State start = test::state_of(s, test::random_disks(draws, s.box, 40, {radius, radius, 1.0, 20.0, 2.0}));
    const State end = test::run(s, start);
    const auto virial_of = [](const Disks& d) {
      double sum = 0.0;
      for (std::size_t i = 0; i < d.size(); ++i) sum += d.mass_of(i) * (d.x[i] * d.vx[i] + d.y[i] * d.vy[i]);
      return sum;
    };
    const double* wall = end.counters.wall_impulse;
    const double by_walls = radius * (wall[0] + wall[2]) - (width - radius) * wall[1] - (height - radius) * wall[3];
    const double by_motion = 2.0 * energy_of(start.disks, s.physics.gravity).kinetic * s.run.t_end;
    EXPECT_NEAR(virial_of(end.disks) - virial_of(start.disks), by_motion + end.counters.virial + by_walls,
                1e-12 * by_motion);
    EXPECT_GT(end.counters.collisions, 100U);
    EXPECT_GT(end.counters.wall_collisions, 50U);
  }
}

// For disks that begin at rest, or come to rest, the drift of momentum is relative to the larger momentum.
TEST(MomentumDrift, IsOfTheLargerMomentum) {
  const Momentum none, some{3.0, 4.0, 10.0};
  EXPECT_EQ(momentum_drift(none, some), 0.5);
  EXPECT_EQ(momentum_drift(some, none), 0.5);
  EXPECT_EQ(momentum_drift(none, none), 0.0);
}

}  // namespace
}  // namespace carom
