// Motion between collisions, formulas (14) to (24) of docs/original.md: straight, parabolic, reversed, Brownian.
#include "core/physics/advance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// Disks keep the sign of a zero velocity across gravity, since the engine's kernels do not change that velocity either.
TEST(Drift, GravityDownwardsLeavesTheVelocityAlongXAlone) {
  for (const double t : {-0.5, 0.5}) {
    double x = 1.0, y = 2.0, vx = -0.0, vy = 3.0;
    drift<true>(x, y, vx, vy, t, 8.0);
    EXPECT_TRUE(std::signbit(vx)) << t;
    EXPECT_EQ(x, 1.0);
  }
}

// (14), (15), (20), (21), with numbers whose products are exact in binary.
TEST(Drift, IsTheFormula) {
  double x = 1.0, y = 2.0, vx = 0.5, vy = -0.25;
  drift<false>(x, y, vx, vy, 4.0, 8.0);
  EXPECT_EQ(x, 3.0);
  EXPECT_EQ(y, 1.0);
  EXPECT_EQ(vx, 0.5);
  EXPECT_EQ(vy, -0.25);
  drift<true>(x, y, vx, vy, 0.5, 8.0);
  EXPECT_EQ(x, 3.25);
  EXPECT_EQ(y, 1.0 - 0.125 - 1.0);
  EXPECT_EQ(vx, 0.5);
  EXPECT_EQ(vy, -4.25);
}

TEST(Drift, WithoutGravityBothKindsGiveTheSameBits) {
  test::Draws draws(1);
  for (int k = 0; k < 1000; ++k) {
    double a[4], b[4];
    for (int i = 0; i < 4; ++i) a[i] = b[i] = draws.in(-10.0, 10.0);
    const double t = draws.in(-2.0, 2.0);
    drift<false>(a[0], a[1], a[2], a[3], t, 0.0);
    drift<true>(b[0], b[1], b[2], b[3], t, 0.0);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(a[i], b[i]);
  }
}

// A parabola has no truncation error: energy is conserved, the place does not depend on how the time is divided, and t
// followed by -t cancels.
TEST(Drift, ParabolaIsExactAndReversible) {
  test::Draws draws(2);
  for (int k = 0; k < 1000; ++k) {
    const double g = draws.in(0.0, 2.0);
    const double t = draws.in(-3.0, 3.0);
    const double start[4] = {draws.in(-10, 10), draws.in(-10, 10), draws.in(-5, 5), draws.in(-5, 5)};
    double s[4] = {start[0], start[1], start[2], start[3]};
    double parts[4] = {start[0], start[1], start[2], start[3]};
    drift<true>(s[0], s[1], s[2], s[3], t, g);
    const auto energy = [&](const double* p) { return 0.5 * (p[2] * p[2] + p[3] * p[3]) + g * p[1]; };
    EXPECT_NEAR(energy(s), energy(start), 1e-13);
    for (int i = 0; i < 8; ++i) drift<true>(parts[0], parts[1], parts[2], parts[3], 0.125 * t, g);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(parts[i], s[i], 1e-13);
    drift<true>(s[0], s[1], s[2], s[3], -t, g);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(s[i], start[i], 2e-14);
  }
}

// Fall from rest: y = -g t^2 / 2 for any number of steps. (A first-order rule would be wrong by g t dt / 2.)
TEST(Drift, FreeFallHasNoErrorOfTheStep) {
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;
  for (int k = 0; k < 1000; ++k) drift<true>(x, y, vx, vy, 0.01, 9.81);
  EXPECT_NEAR(y, -0.5 * 9.81 * 100.0, 1e-10);
  EXPECT_NEAR(vy, -98.1, 1e-11);
}

// (24): u = v dt has variance 2 D dt in each component. With n = 40000 draws the estimate has a relative variance of 2
// / n; the tolerance is 4 standard errors.
TEST(Brownian, DisplacementOfAStepHasVarianceTwoDdt) {
  constexpr int n = 20000;
  const double diffusion = 0.3;
  const double dt = 0.02;
  double sum = 0.0;
  for (DiskId id = 0; id < n; ++id) {
    const Vec2 v = brownian_velocity(5, id, 17, diffusion, dt);
    sum += (v.x * v.x + v.y * v.y) * dt * dt;
  }
  const double variance = sum / (2.0 * n);
  EXPECT_NEAR(variance / (2.0 * diffusion * dt), 1.0, 4.0 * std::sqrt(2.0 / (2.0 * n)));
}

// 900 disks that never meet have a mean square displacement of 4 D t. r^2 is exponentially distributed, so the standard
// error is the mean over sqrt(n). Both methods; the tolerance is 3 standard errors.
TEST(Brownian, FreeMeanSquareDisplacementIsFourDt) {
  constexpr int side = 30;
  for (Method method : test::stepping_methods) {
    Scene scene = test::scene_of(method, 40.0 * side, 40.0 * side, 0.1, 10.0);
    scene.physics.diffusion = 0.5;
    std::vector<Disk> list;
    for (int k = 0; k < side * side; ++k) {
      const Vec2 p = test::cell_centre(k, side, 40.0);
      list.push_back({p.x, p.y, 0.0, 0.0, 1.0, 1.0});
    }
    const Disks start = test::disks_of(list);
    const State end = test::run(scene, test::state_of(scene, list));
    ASSERT_EQ(end.counters.collisions, 0U);
    double sum = 0.0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double dx = end.disks.x[i] - start.x[i];
      const double dy = end.disks.y[i] - start.y[i];
      sum += dx * dx + dy * dy;
    }
    const double expected = 4.0 * scene.physics.diffusion * scene.run.t_end;
    EXPECT_NEAR(sum / (side * side), expected, 3.0 * expected / side) << test::name_of(method);
  }
}

// A centre that drifts is wrapped along each axis separately, and only along those requested.
TEST(Wrap, PerAxis) {
  Domain box;
  box.width = 10.0;
  box.height = 20.0;
  double x = 10.5, y = -0.5;
  wrap<true, false>(x, y, box);
  EXPECT_EQ(x, 0.5);
  EXPECT_EQ(y, -0.5);
  wrap<false, true>(x, y, box);
  EXPECT_EQ(x, 0.5);
  EXPECT_EQ(y, 19.5);
}

}  // namespace
}  // namespace carom
