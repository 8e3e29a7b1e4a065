// Exact cases (docs/reference_values.md, "Exact cases"), which the stepping methods reproduce to rounding or converge
// to with dt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/reference_run.hpp"
#include "tests/support/wide.hpp"

namespace carom {
namespace {

class Golden : public testing::TestWithParam<Method> {
 protected:
  Scene scene(double side, double dt, double t_end) const { return test::scene_of(GetParam(), side, side, dt, t_end); }
};

INSTANTIATE_TEST_SUITE_P(Methods, Golden, testing::ValuesIn(test::stepping_methods),
                         [](const auto& method) { return test::name_of(method.param); });

// Masses 1 and 3, e = 1, the first disk along a line 0.5 above the second one's centre, r1 + r2 = 1; contact at 4 -
// sqrt(0.75).
TEST_P(Golden, TwoDisks) {
  const Scene s = scene(20.0, 0.03, 6.0);
  const State end = test::run(s, test::state_of(s, {{1.0, 5.5, 1.0, 0.0, 0.4, 1.0}, {5.0, 5.0, 0.0, 0.0, 0.6, 3.0}}));
  const double contact = 4.0 - std::sqrt(0.75);
  const double left = 6.0 - contact;
  EXPECT_NEAR(end.disks.vx[0], -0.125, 1e-13);
  EXPECT_NEAR(end.disks.vy[0], 0.375 * std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(end.disks.vx[1], 0.375, 1e-13);
  EXPECT_NEAR(end.disks.vy[1], -0.125 * std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(end.disks.x[0], 1.0 + contact - 0.125 * left, 1e-13);
  EXPECT_NEAR(end.disks.y[1], 5.0 - 0.125 * std::sqrt(3.0) * left, 1e-13);
  // Virial of the collision: |impulse| (r1 + r2) = 2 mu |u_n| = 1.5 sqrt(0.75).
  EXPECT_NEAR(end.counters.virial, 1.5 * std::sqrt(0.75), 1e-13);
}

// Equal masses in a row pass the velocity on, with gaps between them or without.
TEST_P(Golden, NewtonsCradle) {
  for (const double gap : {0.1, 0.0}) {
    const Scene s = scene(30.0, 0.01, 6.0);
    std::vector<Disk> row{{2.0, 5.0, 1.0, 0.0, 0.5, 1.0}};
    for (int k = 0; k < 5; ++k) row.push_back({4.0 + k * (1.0 + gap), 5.0, 0.0, 0.0, 0.5, 1.0});
    const State end = test::run(s, test::state_of(s, row));
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(end.disks.vx[i], 0.0, 1e-13) << gap;
    EXPECT_NEAR(end.disks.vx[5], 1.0, 1e-13) << gap;
    if (gap > 0.0) {
      EXPECT_EQ(end.counters.collisions,
                5U);  // in contact there may be further collisions, by rounding, that change nothing
    }
    // The last disk starts when the first one has covered all gaps.
    const double place = 4.0 + 4.0 * (1.0 + gap) + 6.0 - 1.0 - 4.0 * gap;
    EXPECT_NEAR(end.disks.x[5], place, gap > 0.0 ? 1e-12 : 0.05);
  }
}

// Hard rods: disks in a row never pass each other, so the k-th disk is on the k-th of the sorted free paths, shrunk by
// the diameters. The tolerance is the error of adding v dt to x 10000 times, half a unit in the last place of x < 512
// each.
TEST_P(Golden, HardRods) {
  constexpr std::size_t n = 12;
  test::Draws draws(7);
  const Scene s = scene(400.0, 0.002, 20.0);
  std::vector<Disk> row;
  std::vector<double> free_paths;
  for (std::size_t k = 0; k < n; ++k) {
    row.push_back({180.0 + 3.0 * static_cast<double>(k) + draws.in(0.0, 1.5), 5.0, draws.in(-2.0, 2.0), 0.0, 0.5, 1.0});
    free_paths.push_back(row.back().x - static_cast<double>(k) + row.back().vx * s.run.t_end);
  }
  const State end = test::run(s, test::state_of(s, row));
  EXPECT_GT(end.counters.collisions, n);
  std::sort(free_paths.begin(), free_paths.end());
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(end.disks.x[k], free_paths[k] + static_cast<double>(k), 10000 * 0x1p-45);
    EXPECT_EQ(end.disks.vy[k], 0.0);
  }
}

// A wall, a light disk at rest, and a heavy disk coming in, with mass ratio 100^k: the number of collisions has the
// digits of pi.
TEST_P(Golden, CollisionsCountDigitsOfPi) {
  const Count expected[] = {3, 31, 314};
  const double dt[] = {0.01, 0.001, 0.0001};
  for (int k = 0; k < 3; ++k) {
    const State close =
        test::run(scene(100.0, dt[k], 6.0),
                  test::state_of({}, {{2.0, 5.0, 0.0, 0.0, 0.5, 1.0}, {5.0, 5.0, -1.0, 0.0, 0.5, std::pow(100.0, k)}}));
    // The last few collisions come late, when the disks are far apart, so a longer dt is enough for them.
    State apart = close;
    apart.time = 0.0;
    apart.counters.steps = 0;
    const State end = test::run(scene(100.0, 0.01, 60.0), apart);
    EXPECT_EQ(end.counters.collisions + end.counters.wall_collisions, expected[k]) << k;
    EXPECT_GE(end.disks.vx[1], end.disks.vx[0]);
    EXPECT_GE(end.disks.vx[0], 0.0);
  }
}

struct Bounces {
  double rest_time = 0.0;
  double path = 0.0;
  double height = 0.0;  // above the floor at the end
};

Bounces drop(const Scene& scene, double height) {
  const State start = test::state_of(scene, {{5.0, 1.0 + height, 0.0, 0.0, 1.0, 1.0}});
  Bounces b;
  double y = start.disks.y[0];
  const double slow = 2.0 * scene.physics.gravity.down * scene.run.dt;
  test::run(scene, start, [&](const Engine& engine) {
    const Disks& d = engine.state().disks;
    b.path += std::abs(d.y[0] - y);
    y = d.y[0];
    if (std::abs(d.vy[0]) > slow) b.rest_time = engine.state().time;
  });
  b.height = y - 1.0;
  return b;
}

// Dropped from height h with restitution e the disk comes to rest at sqrt(2 h / g) (1 + e)/(1 - e), after a path of h
// (1 + e^2)/(1 - e^2). Bounces too short for a step make a first-order error: with a quarter of the step less than a
// third of it is left.
TEST_P(Golden, BouncingBall) {
  for (const double e : {0.5, 0.7}) {
    const double h = 4.0;
    const double rest_time = std::sqrt(2.0 * h) * (1.0 + e) / (1.0 - e);
    const double path = h * (1.0 + e * e) / (1.0 - e * e);
    Bounces coarser;
    for (const double dt : {0.02, 0.005, 0.00125}) {
      Scene s = scene(10.0, dt, 20.0);
      s.physics.gravity = 1.0;
      s.box.restitutions.fill(e);
      const Bounces b = drop(s, h);
      std::printf("%s e %g dt %g: rest time %+.3g, path %+.3g, height %.3g\n", test::name_of(GetParam()).c_str(), e, dt,
                  b.rest_time - rest_time, b.path - path, b.height);
      EXPECT_NEAR(b.rest_time, rest_time, 10.0 * dt / (1.0 - e));
      EXPECT_NEAR(b.path, path, 5.0 * dt / (1.0 - e));
      EXPECT_NEAR(b.height, 0.0, 2.001 * dt * dt);  // far below contact_slop (resting.hpp)
      if (dt < 0.02) {
        EXPECT_LT(std::abs(b.rest_time - rest_time), std::abs(coarser.rest_time - rest_time) / 3.0);
        EXPECT_LT(std::abs(b.path - path), std::abs(coarser.path - path) / 3.0);
      }
      coarser = b;
    }
  }
}

// Elastic motion is reversible: with velocities reversed at T all disks return to where they started, up to the
// rounding errors of 1e-16 amplified by chaos.
TEST_P(Golden, Reversible) {
  test::Draws draws(11);
  const Scene s = scene(15.0, 0.002, 6.0);
  const State start = test::state_of(s, test::random_disks(draws, s.box, 30, {0.4, 0.8, 1.0, 5.0, 1.0}));
  State turned = test::run(s, start);
  EXPECT_GT(turned.counters.collisions, 30U);
  for (double& v : turned.disks.vx) v = -v;
  for (double& v : turned.disks.vy) v = -v;
  turned.time = 0.0;
  turned.counters = {};
  const State back = test::run(s, turned);
  for (std::size_t i = 0; i < start.disks.size(); ++i) {
    EXPECT_NEAR(back.disks.x[i], start.disks.x[i], 1e-9);
    EXPECT_NEAR(back.disks.y[i], start.disks.y[i], 1e-9);
    EXPECT_NEAR(back.disks.vx[i], -start.disks.vx[i], 1e-9);
  }
}

// scenes/two_disks.toml: each collision of the run is computed from the paths before the step, the contact time, and
// (23) of docs/original.md, with more digits than a double has.
TEST_P(Golden, TwoDisksSceneCollidesByRule23) {
  using test::wide;
  using test::Wide;
  Scene s = load_scene(CAROM_SOURCE_DIR "/scenes/two_disks.toml");
  s.run.method = GetParam();
  const Wide g = wide(s.physics.gravity.down);
  const Wide e = wide(s.physics.restitution);
  State before = initial_state(s);
  const Wide m1 = wide(before.disks.mass_of(0)), m2 = wide(before.disks.mass_of(1));
  const Wide reach = wide(before.disks.radius_of(0)) + wide(before.disks.radius_of(1));
  int collisions = 0;
  test::run(s, before, [&](const Engine& engine) {
    const State& after = engine.state();
    const bool hit = after.counters.collisions > before.counters.collisions;
    if (hit && after.counters.wall_collisions == before.counters.wall_collisions) {
      ++collisions;
      const Disks& d = before.disks;
      const Wide vx1 = wide(d.vx[0]), vx2 = wide(d.vx[1]);
      const Wide dx = wide(d.x[1]) - wide(d.x[0]), dy = wide(d.y[1]) - wide(d.y[0]);
      const Wide dvx = vx2 - vx1, dvy = wide(d.vy[1]) - wide(d.vy[0]);
      const Wide a = dvx * dvx + dvy * dvy, b = dx * dvx + dy * dvy, c = dx * dx + dy * dy - reach * reach;
      const Wide t = c / (-b + std::sqrt(b * b - a * c));
      const Wide nx = (dx + dvx * t) / reach, ny = (dy + dvy * t) / reach;
      const Wide vy1 = wide(d.vy[0]) - g * t, vy2 = wide(d.vy[1]) - g * t;
      const Wide n1 = vx1 * nx + vy1 * ny, n2 = vx2 * nx + vy2 * ny;
      const Wide w2 = (n1 * (1 + e) + n2 * (m2 / m1 - e)) / (1 + m2 / m1);
      const Wide w1 = n1 + m2 / m1 * (n2 - w2);
      const Wide left = wide(after.time) - wide(before.time) - t;  // the rest of the step, after the contact
      const auto narrow = [](Wide x) { return static_cast<double>(x); };
      EXPECT_NEAR(after.disks.vx[0], narrow(vx1 + (w1 - n1) * nx), 1e-12);
      EXPECT_NEAR(after.disks.vy[0], narrow(vy1 + (w1 - n1) * ny - g * left), 1e-12);
      EXPECT_NEAR(after.disks.vx[1], narrow(vx2 + (w2 - n2) * nx), 1e-12);
      EXPECT_NEAR(after.disks.vy[1], narrow(vy2 + (w2 - n2) * ny - g * left), 1e-12);
    }
    before = after;
  });
  EXPECT_GE(collisions, 5);
  std::printf("%s: %d collisions of two_disks compared with (23)\n", test::name_of(GetParam()).c_str(), collisions);
}

}  // namespace
}  // namespace carom
