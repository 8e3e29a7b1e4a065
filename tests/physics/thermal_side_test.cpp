// Thermal sides: Maxwell's flux distribution, equipartition, the balance of heat.
#include "core/physics/thermal_side.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

using test::energy_from_sides;
using test::run_by_engine;

// The test of Kolmogorov and Smirnov: one sample in 10^5 deviates by more than 2.23 / sqrt(n).
TEST(ThermalSide, DrawsMaxwellsFluxDistribution) {
  constexpr std::size_t n = 200'000;
  constexpr double scale = 1.7;
  std::vector<double> away;
  double along2 = 0.0;
  double along4 = 0.0;
  double product = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const FluxVelocity v = flux_velocity(5, Stream::thermal_side, static_cast<DiskId>(k % 100), k / 100, scale);
    away.push_back(v.away);
    along2 += v.along * v.along;
    along4 += v.along * v.along * v.along * v.along;
    product += v.away * v.along;
  }
  std::sort(away.begin(), away.end());
  double worst = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double cumulative = 1.0 - std::exp(-away[k] * away[k] / (2.0 * scale * scale));
    worst = std::max(worst, std::abs(cumulative - (static_cast<double>(k) + 0.5) / n));
  }
  const double root = std::sqrt(static_cast<double>(n));
  EXPECT_LT(worst, 2.23 / root);
  EXPECT_NEAR(along2 / n / (scale * scale), 1.0, 5.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(along4 / n / (3.0 * std::pow(scale, 4)), 1.0, 5.0 * 3.3 / root);
  EXPECT_NEAR(product / n / (scale * scale), 0.0, 5.0 * std::sqrt(2.0) / root);
}

// The numbers of a draw are independent of each other, and of those of a disk's next draw: the means of products are 0,
// and those of products of squares equal the products of the means. In units of s, away^2 has mean 2 and variance 4,
// the square of a normal deviate 1 and 2, so the products deviate by at most sqrt(8 / n) and sqrt(2 2 / n); the
// tolerance is five times that.
TEST(ThermalSide, DrawsTheNumbersApart) {
  constexpr DiskId n = 100'000;
  double along_away = 0.0, along_more = 0.0, more_away = 0.0, sign = 0.0, next_along = 0.0, next_away = 0.0;
  for (DiskId id = 0; id < n; ++id) {
    const FluxVelocity v = flux_velocity(9, Stream::thermal_side, id, 3, 1.0);
    const FluxVelocity w = flux_velocity(9, Stream::thermal_side, id, 4, 1.0);
    along_away += (v.away * v.away - 2.0) * (v.along * v.along - 1.0);
    more_away += (v.away * v.away - 2.0) * (v.more * v.more - 1.0);
    along_more += (v.along * v.along - 1.0) * (v.more * v.more - 1.0);
    sign += v.along * v.more;
    next_along += v.along * w.along + v.more * w.along;
    next_away +=
        (v.along * v.along - 1.0) * (w.away * w.away - 2.0) + (v.away * v.away - 2.0) * (w.along * w.along - 1.0);
  }
  const double root = std::sqrt(static_cast<double>(n));
  EXPECT_NEAR(along_away / n, 0.0, 5.0 * std::sqrt(8.0) / root);
  EXPECT_NEAR(more_away / n, 0.0, 5.0 * std::sqrt(8.0) / root);
  EXPECT_NEAR(along_more / n, 0.0, 5.0 * 2.0 / root);
  EXPECT_NEAR(sign / n, 0.0, 5.0 / root);
  EXPECT_NEAR(next_along / n, 0.0, 5.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(next_away / n, 0.0, 5.0 * 4.0 / root);
}

// A rough side draws the spin from I w^2 = T n^2 with I = q m r^2, and adds the change of rotational energy to its
// account.
TEST(ThermalSide, DrawsTheSpinByTheMomentOfInertia) {
  double spin = -2.0;
  const double given = spin_thermally(0.5, 3.0, 4.0, 0.25, 1.5, spin);
  const double inertia = 0.5 * 4.0 * 0.25 * 0.25;
  EXPECT_DOUBLE_EQ(inertia * spin * spin, 3.0 * 1.5 * 1.5);
  EXPECT_GT(spin, 0.0);
  EXPECT_DOUBLE_EQ(given, 0.5 * 3.0 * 1.5 * 1.5 - 0.5 * inertia * 4.0);
}

// A wall in each direction sends the disk back into the box.
TEST(ThermalSide, SendsADiskInward) {
  for (const Side side : all_sides) {
    double vx = 0.0;
    double vy = 0.0;
    leave_side(side, {2.0, -0.5}, vx, vy);
    EXPECT_EQ(outward_speed(side, vx, vy), -2.0);
    EXPECT_EQ(vx * vx + vy * vy, 4.25);
  }
}

Scene gas(const std::string& method, double temperature, const std::string& physics) {
  const std::string side = " = { temperature = " + std::to_string(temperature) + " }\n";
  return parse_scene("[box]\nwidth = 20.0\nheight = 16.0\nleft" + side + "right" + side + "bottom" + side + "top" +
                         side + "[physics]\n" + physics +
                         "\n[[disks]]\ncount = 150\npositions = \"random\"\nvelocities = { maxwell = 5.0 }\n"
                         "radius = { uniform = [0.2, 0.5] }\nmass = { uniform = [1, 9] }\n[run]\nmethod = \"" +
                         method + "\"\ndt = 0.005\nt_end = 300.0\n",
                     "gas", "");
}

// A gas that is too hot reaches the temperature of its walls, light and heavy disks alike; its energy is that of the
// start plus what the sides gave.
TEST(ThermalSide, BringsAGasToItsTemperature) {
  Scene scene = gas("exact", 2.0, "");
  scene.run.t_end = 3000.0;  // long enough that chance changes the means by only a hundredth
  const State start = initial_state(scene);
  double light = 0.0;
  double heavy = 0.0;
  std::size_t lights = 0;
  std::size_t heavies = 0;
  const State end = run_by_engine(scene, start, [&](const State& s) {
    if (s.time < 60.0) return;
    const Disks& d = s.disks;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double energy = 0.5 * d.mass_of(i) * (d.vx[i] * d.vx[i] + d.vy[i] * d.vy[i]);
      (d.mass_of(i) < 5.0 ? light : heavy) += energy;
      ++(d.mass_of(i) < 5.0 ? lights : heavies);
    }
  });
  EXPECT_NEAR(light / static_cast<double>(lights), 2.0, 0.06);
  EXPECT_NEAR(heavy / static_cast<double>(heavies), 2.0, 0.06);
  const double before = energy_of(start.disks, 0.0).total();
  const double after = energy_of(end.disks, 0.0).total();
  EXPECT_NEAR(before + energy_from_sides(end), after, 1e-12 * (before + after));
  EXPECT_GT(end.counters.wall_collisions, 40'000U);
}

// The balance of heat under gravity, for every method: the sides are the only source of energy. Stepping under gravity
// is accurate to first order only.
TEST(ThermalSide, GivesTheEnergyThatIsGained) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    for (const std::string physics : {"", "gravity = 0.5"}) {
      SCOPED_TRACE(method + physics);
      Scene scene = gas(method, 2.0, physics);
      scene.run.t_end = 20.0;
      const State start = initial_state(scene);
      const State end = run_by_engine(scene, start);
      const double g = scene.physics.gravity.down;
      const double before = energy_of(start.disks, g).total();
      const double after = energy_of(end.disks, g).total();
      EXPECT_LT(energy_from_sides(end), -0.1 * before);
      EXPECT_NEAR(before + energy_from_sides(end), after, (g > 0.0 && method != "exact" ? 1e-2 : 1e-11) * before);
      EXPECT_LE(wall_overlap(end.disks, scene.box), 1e-12);
    }
  }
}

}  // namespace
}  // namespace carom
