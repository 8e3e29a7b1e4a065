// Energy without a source: what counts as put in, how much rounding is allowed, and when nothing can be said.
#include "core/measure/energy_gain.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

// A run that began with an energy of 10, of which 4 were potential.
const RunStart start{1, 0.0, {5.0, 4.0, 1.0}, {}};

bool warns(const Scene& scene, const State& state, double energy) {
  return !energy_warnings(scene, start, state, Energy{energy, 0.0, 0.0}).empty();
}

Scene closed_box(Method method) {
  return test::scene_of(method, 10.0, 10.0, 0.01, 1.0);
}

// The final energy may differ by what the sources of energy gave or took, and by no more.
TEST(EnergyGain, IsWhatIsMoreThanWasPutIn) {
  const std::vector<std::function<double&(Counters&)>> givers{
      [](Counters& c) -> double& { return c.emitted_energy; }, [](Counters& c) -> double& { return c.side_energy[0]; },
      [](Counters& c) -> double& { return c.side_energy[3]; }, [](Counters& c) -> double& { return c.thermostat_heat; },
      [](Counters& c) -> double& { return c.shear_work; },     [](Counters& c) -> double& { return c.wall_work; }};
  for (const Method method : {Method::exact, Method::pairwise}) {
    const Scene scene = closed_box(method);
    const double most = method == Method::exact ? most_gain_exact : most_gain_stepping;
    for (std::size_t k = 0; k < givers.size(); ++k) {
      for (const double given : {0.0, 3.0, -3.0}) {
        State state;
        givers[k](state.counters) = given;
        const double moved = 10.0 + (given == 0.0 ? 0.0 : 3.0);
        EXPECT_FALSE(warns(scene, state, 10.0 + given + 0.99 * most * moved)) << k << ", " << given;
        EXPECT_TRUE(warns(scene, state, 10.0 + given + 1.01 * most * moved)) << k << ", " << given;
        EXPECT_FALSE(warns(scene, state, 1.0)) << "less energy is no gain";
      }
    }
  }
}

// Energy that one side gave and another took has passed through the disks, so its rounding is allowed, too.
TEST(EnergyGain, IsHeldAgainstAllThatHasPassedThrough) {
  State state;
  state.counters.side_energy[2] = 1e6;
  state.counters.side_energy[3] = -1e6;
  EXPECT_FALSE(warns(closed_box(Method::exact), state, 10.0 + 1e-3));
  EXPECT_TRUE(warns(closed_box(Method::exact), state, 10.0 + 3e-3));
  state.counters.side_energy[3] = 0.0;
  state.counters.wall_work = -1e6;
  EXPECT_FALSE(warns(closed_box(Method::exact), state, 10.0 + 1e-3));
}

// The potential is 0 at the lower left corner: one far below 0 is as inexact as one far above.
TEST(EnergyGain, IsHeldAgainstANegativePotentialToo) {
  const RunStart deep{1, 0.0, {5.0, -1e6, 0.0}, {}};
  const auto warns_of = [&](double gain) {
    return !energy_warnings(closed_box(Method::exact), deep, {}, Energy{5.0 + gain, -1e6, 0.0}).empty();
  };
  EXPECT_FALSE(warns_of(0.9e-3));
  EXPECT_TRUE(warns_of(1.1e-3));
}

// With gravity to the right or up potential energies are negative: a disk that leaves may take negative energy with it,
// which raises that of the others.
TEST(EnergyGain, IsUnknownWhereDisksMayHaveTakenLessThanNothing) {
  State state;
  for (const Gravity& g : {Gravity(-0.5, 0.0), Gravity(0.0, -0.5), Gravity(0.5, -0.5), Gravity(-0.5, 0.5)}) {
    Scene scene = closed_box(Method::exact);
    scene.physics.gravity = g;
    state.counters.removed = 0;
    EXPECT_TRUE(warns(scene, state, 11.0)) << g.left << ", " << g.down;
    state.counters.removed = 1;
    EXPECT_FALSE(warns(scene, state, 11.0)) << g.left << ", " << g.down;
  }
  Scene scene = closed_box(Method::exact);
  scene.physics.gravity = Gravity(0.5, 0.5);
  EXPECT_TRUE(warns(scene, state, 11.0)) << "the disks that left had energies of at least 0";
}

// Along periodic sides the potential energy starts anew in each round; across them gravity acts as between walls.
TEST(EnergyGain, IsUnknownWhereDisksFallForEver) {
  const State state;
  for (const bool along_x : {true, false}) {
    for (const bool periodic_x : {true, false}) {
      Scene scene = closed_box(Method::exact);
      scene.box = test::box_of(10.0, 10.0, periodic_x ? test::Periodic::x : test::Periodic::y);
      scene.physics.gravity = along_x ? Gravity(0.5, 0.0) : Gravity(0.0, 0.5);
      EXPECT_EQ(warns(scene, state, 11.0), along_x != periodic_x);
    }
  }
  Scene brownian = closed_box(Method::exact);
  brownian.physics.diffusion = 1.0;
  EXPECT_FALSE(warns(brownian, state, 11.0)) << "Brownian motion does not conserve energy";
}

}  // namespace
}  // namespace carom
