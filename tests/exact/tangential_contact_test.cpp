// Contacts without approach: disks that touch and pass along each other, and disks that slide along an inner wall. Only
// rounding decides whether they approach, and the impulse that parts them may be below the last place of their
// velocities. Time must advance nevertheless, in the same way in both engines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "parallel/exact/exact_engine.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/exact_support.hpp"

namespace carom::exact_tests {
namespace {

constexpr int seeds = 12;

// Runs both engines for some windows. Returns the last state of the reference.
State run_both(const Scene& scene, const State& start, int windows) {
  const auto reference = make_reference_exact(scene, start);
  const auto alone = make_parallel_exact(scene, start, {1});
  const auto regions = make_parallel_exact(scene, start, {2, 64});
  for (int k = 0; k < windows && !testing::Test::HasFailure(); ++k) {
    reference->step();
    const std::string right = fingerprint(reference->state());
    for (Engine* engine : {alone.get(), regions.get()}) {
      engine->step();
      EXPECT_EQ(fingerprint(engine->state()), right) << "window " << k;
    }
  }
  return reference->state();
}

double energy_of(const Disks& disks) {
  double sum = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) sum += kinetic_energy_of(disks, i);
  return sum;
}

struct PairCase {
  const char* name;
  Gravity gravity{};
  double shear_rate = 0.0;
  bool alike = true;  // equal masses and radii
};

void PrintTo(const PairCase& c, std::ostream* out) {
  *out << c.name;
}

class Tangential : public testing::TestWithParam<PairCase> {};

// One pair in each of 144 cells. The disks touch in some direction, as exactly as doubles allow, and move across it;
// half of the pairs have a common velocity, whose last place is larger than that of the other velocities.
State pairs_that_touch(test::Draws& draws, const PairCase& c) {
  std::vector<Disk> list;
  for (int k = 0; k < 144; ++k) {
    const double x = 5.0 + 10.0 * (k % 12), y = 5.0 + 10.0 * (k / 12);
    const double angle = draws.in(0.0, 2.0 * std::numbers::pi);
    const Vec2 n{std::cos(angle), std::sin(angle)};
    const double slip = draws.in(-0.2, 0.2);
    const Vec2 both = k % 2 == 0 ? Vec2{} : Vec2{draws.in(-1.0, 1.0), draws.in(-1.0, 1.0)};
    const double first = c.alike ? 0.5 : draws.in(0.2, 1.0);
    const double second = c.alike ? 0.5 : draws.in(0.2, 1.0);
    const double mass = c.alike ? 1.0 : draws.in(0.1, 10.0);
    list.push_back({x - n.x * first, y - n.y * first, both.x + slip * n.y, both.y - slip * n.x, first, 1.0});
    list.push_back({x + n.x * second, y + n.y * second, both.x - slip * n.y, both.y + slip * n.x, second, mass});
  }
  return test::state_of(list);
}

// Disks that pass do not push each other: energy and momentum are conserved, and so are the velocities, up to rounding.
TEST_P(Tangential, PairsPassEachOther) {
  const PairCase& c = GetParam();
  for (std::uint32_t seed = 1; seed <= seeds && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::Draws draws(seed);
    Scene scene = plain_scene(test::box_of(120.0, 120.0, test::Periodic::both), 1e9);
    scene.physics.gravity = c.gravity;
    if (c.shear_rate != 0.0) scene.box.shear = {c.shear_rate, c.shear_rate * 120.0, 0.0};
    const State start = pairs_that_touch(draws, c);
    const State end = run_both(scene, start, 2);
    if (c.gravity.acts() || c.shear_rate != 0.0) continue;
    ASSERT_LT(end.time, 5.0);  // no pair can have met another by then
    for (std::size_t i = 0; i < start.disks.size(); ++i) {
      EXPECT_NEAR(end.disks.vx[index_of(end.disks, start.disks.id[i])], start.disks.vx[i], 1e-13);
      EXPECT_NEAR(end.disks.vy[index_of(end.disks, start.disks.id[i])], start.disks.vy[i], 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, Tangential,
                         testing::Values(PairCase{"straight"}, PairCase{"falling", Gravity(0.01, 0.02)},
                                         PairCase{"unlike", {}, 0.0, false}, PairCase{"sheared", {}, 0.1}),
                         [](const auto& p) { return std::string(p.param.name); });

// Disks on both sides of an oblique wall, at a distance of their radius to the last bits, each with its own velocity
// along the wall: they collide in rows and slide off its ends. velocity: of the wall, added to that of all disks.
State sliders(test::Draws& draws, Vec2 u, Vec2 velocity) {
  std::vector<Disk> list;
  constexpr double radius = 0.5;
  for (int k = 0; k < 14; ++k) {
    const double along = 1.9 * k - 12.0;
    const double beside = k % 2 == 0 ? radius : -radius;
    const double v = draws.in(-1.0, 1.0);
    list.push_back({20.0 + u.x * along - u.y * beside, 20.0 + u.y * along + u.x * beside, velocity.x + v * u.x,
                    velocity.y + v * u.y, radius, 1.0});
  }
  return test::state_of(list);
}

class Sliding : public testing::TestWithParam<bool> {};

TEST_P(Sliding, AlongAnInnerWallAndOffItsEnds) {
  for (std::uint32_t seed = 1; seed <= 10 * seeds && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    test::Draws draws(seed);
    const double angle = draws.in(0.05, 1.5);
    const Vec2 u{std::cos(angle), std::sin(angle)};
    const Vec2 velocity = GetParam() ? Vec2{draws.in(-0.1, 0.1), draws.in(-0.1, 0.1)} : Vec2{};
    std::string wall = fmt::format("[[walls]]\nfrom = [{}, {}]\nto = [{}, {}]\n", 20.0 - 15.0 * u.x, 20.0 - 15.0 * u.y,
                                   20.0 + 15.0 * u.x, 20.0 + 15.0 * u.y);
    if (GetParam()) wall += fmt::format("motion = {{ velocity = [{}, {}] }}\n", velocity.x, velocity.y);
    const std::string disks =
        "[[disks]]\ncount = 1\npositions = [[1, 39]]\nvelocities = [[0, 0]]\nradius = 0.5\nmass = 1\n";
    const Scene scene = make_scene({40.0, 40.0, "wall", "", disks + wall, 40.0, ""});
    State start = initial_state(scene);
    start.disks = sliders(draws, u, velocity).disks;
    const double energy = energy_of(start.disks);
    const State end = run_both(scene, start, 14);
    EXPECT_LT(end.counters.wall_collisions, 2000U);
    EXPECT_NEAR(energy_of(end.disks), energy + end.counters.wall_work, 1e-13 * energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Walls, Sliding, testing::Bool(),
                         [](const auto& p) { return std::string(p.param ? "moving" : "at_rest"); });

}  // namespace
}  // namespace carom::exact_tests
