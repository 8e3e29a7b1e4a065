// The exact method compared with closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

TEST(ExactGolden, TwoDisksOfMassOneAndThree) {
  const Scene scene = plain_scene(test::box_of(20, 20), 5.0);
  const State s = run_reference(scene, state_of({{5, 10.5, 1, 0, 0.5, 1, 0}, {8, 10, 0, 0, 0.5, 3, 0}}));
  EXPECT_EQ(s.counters.collisions, 1U);
  const double root = std::sqrt(0.75);
  EXPECT_NEAR(s.disks.vx[0], -0.125, 1e-14);
  EXPECT_NEAR(s.disks.vy[0], 0.75 * root, 1e-14);
  EXPECT_NEAR(s.disks.vx[1], 0.375, 1e-14);
  EXPECT_NEAR(s.disks.vy[1], -0.25 * root, 1e-14);
  // The disks touch when their centres are `root` apart along x, at t = 3 - root.
  const double after = 5.0 - (3.0 - root);
  EXPECT_NEAR(s.disks.x[0], 8.0 - root - 0.125 * after, 1e-13);
  EXPECT_NEAR(s.disks.y[1], 10.0 - 0.25 * root * after, 1e-13);
}

// A wall, a light disk at rest, and a heavy disk coming in: the number of collisions has the digits of pi (Galperin
// 2003).
TEST(ExactGolden, CollisionsThatCountPi) {
  const Count digits[] = {3, 31, 314, 3141};
  double ratio = 1.0;
  for (const Count expected : digits) {
    const Scene scene = plain_scene(test::box_of(1e6, 10), 2000.0);
    const State s = run_reference(scene, state_of({{10, 5, 0, 0, 1, 1, 0}, {20, 5, -1, 0, 1, ratio, 0}}));
    EXPECT_EQ(s.counters.collisions + s.counters.wall_collisions, expected) << "mass ratio " << ratio;
    EXPECT_EQ(s.disks.vy[0], 0.0);
    ratio *= 100.0;
  }
}

TEST(ExactGolden, CradleOfTouchingDisks) {
  std::vector<Disk> disks{{5, 5, 1, 0, 0.5, 1, 0}};
  for (int k = 0; k < 5; ++k) disks.push_back({8.0 + k, 5, 0, 0, 0.5, 1, 0});
  const Scene scene = plain_scene(test::box_of(40, 10), 4.0);
  const State s = run_reference(scene, state_of(disks));
  EXPECT_EQ(s.counters.collisions, 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(s.disks.vx[k], 0.0) << k;
  EXPECT_EQ(s.disks.vx[5], 1.0);
  EXPECT_EQ(s.disks.x[5], 14.0);
}

// Two disks come in, and two go out: velocities are passed on one by one.
TEST(ExactGolden, CradleStruckByTwo) {
  std::vector<Disk> disks{{5, 5, 1, 0, 0.5, 1, 0}, {6, 5, 1, 0, 0.5, 1, 0}};
  for (int k = 0; k < 3; ++k) disks.push_back({8.0 + k, 5, 0, 0, 0.5, 1, 0});
  const State s = run_reference(plain_scene(test::box_of(40, 10), 4.0), state_of(disks));
  const double expected[] = {0, 0, 0, 1, 1};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(s.disks.vx[k], expected[k]) << k;
}

// Equal disks in a row are hard rods: the k-th disk is at the k-th of the sorted free paths between walls moved
// inwards.
TEST(ExactGolden, HardRodsFollowSortedFreePaths) {
  constexpr std::size_t n = 20;
  constexpr double length = 60.0;
  constexpr double t_end = 1700.0;
  std::vector<Disk> disks;
  std::vector<double> point(n);
  std::vector<double> speed(n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto u = uniforms(7, Stream::position, static_cast<DiskId>(k), 0);
    point[k] = (length - n) * (static_cast<double>(k) + u.a) / n;
    speed[k] = 4.0 * (u.b - 0.5);
    disks.push_back({point[k] + static_cast<double>(k) + 0.5, 2, speed[k], 0, 0.5, 1, 0});
  }
  const State s = run_reference(plain_scene(test::box_of(length, 4), t_end), state_of(disks));
  EXPECT_GT(s.counters.collisions, 10000U);
  const double span = length - n;
  std::vector<double> free(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double unfolded = std::fmod(point[k] + speed[k] * t_end, 2.0 * span);
    const double folded = unfolded < 0.0 ? unfolded + 2.0 * span : unfolded;
    free[k] = folded > span ? 2.0 * span - folded : folded;
  }
  std::sort(free.begin(), free.end());
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(s.disks.x[k], free[k] + static_cast<double>(k) + 0.5, 1e-9) << "rod " << k;
    EXPECT_EQ(s.disks.y[k], 2.0);
  }
}

// Dropped from height h the disk comes to rest at sqrt(2 h / g) (1 + e) / (1 - e): the collapse is reported at that
// time, and the last good state is shortly before.
TEST(ExactGolden, BouncingBallRestsInTime) {
  for (const double e : {0.5, 0.8}) {
    Domain box = test::box_of(10, 10);
    box.restitutions.fill(e);
    const Scene scene = plain_scene(box, 100.0, 2.0);
    const auto engine = make_reference_exact(scene, state_of({{5, 5, 0, 0, 1, 1, 0}}));
    const double rest = std::sqrt(2.0 * 4.0 / 2.0) * (1.0 + e) / (1.0 - e);
    std::string message;
    try {
      run_to_end(*engine, scene);
    } catch (const PhysicsError& error) {
      message = error.what();
    }
    ASSERT_NE(message.find("collapse at t = "), std::string::npos) << message;
    EXPECT_NEAR(std::stod(message.substr(message.find("t = ") + 4)), rest, 1e-9 * rest);
    EXPECT_NE(message.find("disk 0"), std::string::npos) << message;
    EXPECT_NE(message.find("contact_time"), std::string::npos) << message;
    EXPECT_LE(engine->state().time, rest);
    EXPECT_GE(engine->state().disks.y[0], 1.0 - 1e-12);
  }
}

// A few bounces earlier each bounce leaves with e times its incoming speed.
TEST(ExactGolden, BouncingBallKeepsItsParabolas) {
  Domain box = test::box_of(10, 100);
  box.restitutions.fill(0.5);
  // The fall takes 1, and the flights after it 1, 1/2, 1/4; the time is 0.1 after the start of the next one.
  const State s = run_reference(plain_scene(box, 2.85, 8.0), state_of({{5, 5, 0, 0, 1, 1, 0}}));
  EXPECT_EQ(s.counters.wall_collisions, 4U);
  EXPECT_NEAR(s.disks.vy[0], 0.5 - 0.8, 1e-12);
  EXPECT_NEAR(s.disks.y[0], 1.0 + 0.5 * 0.1 - 4.0 * 0.01, 1e-12);
}

TEST(ExactGolden, TimeReversalComesBack) {
  for (const char* sides : {"wall", "periodic"}) {
    const Scene scene = make_scene(
        {12, 12, sides, "",
         "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 1.0", 2.5,
         ""});
    const State initial = initial_state(scene);
    const State there = run_reference(scene, initial);
    State turned;
    turned.disks = there.disks;
    for (double& v : turned.disks.vx) v = -v;
    for (double& v : turned.disks.vy) v = -v;
    const State back = run_reference(scene, turned);
    EXPECT_GT(there.counters.collisions, 150U);
    EXPECT_EQ(there.counters.collisions, back.counters.collisions);
    for (std::size_t i = 0; i < initial.disks.size(); ++i) {
      EXPECT_NEAR(back.disks.x[i], initial.disks.x[i], 1e-7);
      EXPECT_NEAR(back.disks.y[i], initial.disks.y[i], 1e-7);
    }
  }
}

// The floor's force minus the ceiling's is the weight: over a time T the impulses differ by N m g T and the change of
// momentum.
TEST(ExactGolden, FloorMinusCeilingIsTheWeight) {
  const Scene scene = make_scene(
      {12, 12, "wall", "gravity = 0.7",
       "[[disks]]\ncount = 60\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\nmass = 2.0", 20,
       ""});
  const State initial = initial_state(scene);
  const State s = run_reference(scene, initial);
  const auto& w = s.counters.wall_impulse;
  const double gained = momentum_of(s.disks).y - momentum_of(initial.disks).y;
  EXPECT_GT(w[static_cast<std::size_t>(Side::top)], 0.0);
  EXPECT_NEAR(w[static_cast<std::size_t>(Side::bottom)] - w[static_cast<std::size_t>(Side::top)],
              60.0 * 2.0 * 0.7 * 20.0 + gained, 1e-8);
  EXPECT_NEAR(w[static_cast<std::size_t>(Side::left)] - w[static_cast<std::size_t>(Side::right)],
              momentum_of(s.disks).x - momentum_of(initial.disks).x, 1e-9);
}

// The virial counts |impulse| (r1 + r2); here two disks meet head-on.
TEST(ExactGolden, VirialOfOneCollision) {
  const State s = run_reference(plain_scene(test::box_of(20, 20), 4.0),
                                state_of({{5, 10, 1, 0, 0.5, 1, 0}, {9, 10, -1, 0, 1.0, 3, 0}}));
  EXPECT_EQ(s.counters.collisions, 1U);
  EXPECT_NEAR(s.counters.virial, 0.75 * 2.0 * 2.0 * 1.5, 1e-14);
}

}  // namespace
}  // namespace carom::exact_tests
