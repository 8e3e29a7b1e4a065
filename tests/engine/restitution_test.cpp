// Restitution that depends on pairs of groups and on the speed of approach: the root that it needs, single collisions
// in every method, the same bits from both engines on any number of threads and after resume, and no hidden unit.
// clang, unlike g++, warns of each conversion from double to long double as a promotion by mistake; here it is
// intended.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"
#endif

#include "core/physics/restitution.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/load/scene_scales.hpp"
#include "core/measure/invariants.hpp"
#include "core/step/step_start.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/draws.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/resume_support.hpp"
#include "tests/support/run_in_all_units.hpp"
#include "tests/support/state_bits.hpp"

namespace carom {
namespace {

// The error compared with the root in long double, in units of the last place.
double error_of_root(double v) {
  const long double right = std::pow(static_cast<long double>(v), 0.2L);
  const double root = fifth_root(v);
  const double unit = std::nextafter(root, HUGE_VAL) - root;
  return static_cast<double>(std::abs(static_cast<long double>(root) - right) / static_cast<long double>(unit));
}

TEST(FifthRoot, IsRightToAUnitInTheLastPlace) {
  test::Draws draws(1);
  for (int k = 0; k < 200'000; ++k) {
    const double v = std::ldexp(draws.in(1.0, 2.0), static_cast<int>(draws.bits() % 2097) - 1073);
    ASSERT_LT(error_of_root(v), 1.0) << v;
  }
  for (int k = -1074; k <= 1023; ++k) {
    const double v = std::ldexp(1.0, k);
    ASSERT_LT(error_of_root(v), 1.0) << v;
    ASSERT_LT(error_of_root(std::nextafter(v, v < 1.0 ? 0.0 : HUGE_VAL)), 1.0) << v;
    ASSERT_LT(error_of_root(std::nextafter(v, 1.0)), 1.0) << v;
  }
  EXPECT_LT(error_of_root(std::numeric_limits<double>::max()), 1.0);
  EXPECT_EQ(fifth_root(0.0), 0.0);
  EXPECT_EQ(fifth_root(1.0), 1.0);
}

TEST(FifthRoot, OfANumberTimes32IsTwiceIt) {
  test::Draws draws(2);
  for (int k = 0; k < 10'000; ++k) {
    const double v = draws.decades(1e-3, 1e3);
    for (const int q : {-180, -20, -1, 1, 20, 180}) {
      ASSERT_EQ(fifth_root(std::ldexp(v, 5 * q)), std::ldexp(fifth_root(v), q)) << v << " 32^" << q;
    }
  }
}

TEST(RestitutionLaw, FindsThePairInEitherOrder) {
  RestitutionLaw law;
  EXPECT_TRUE(law.is_empty());
  law.ends = {10, 30, 30, 60};
  law.pairs = {{0, 1, {0.5, 0.0}}, {1, 1, {0.25, 0.0}}, {3, 4, {0.125, 2.0}}};
  const Restitution rest{0.9, 0.0};
  EXPECT_EQ(law.of(0.9, 3, 5), rest);
  EXPECT_EQ(law.of(0.9, 9, 10), (Restitution{0.5, 0.0}));
  EXPECT_EQ(law.of(0.9, 29, 0), (Restitution{0.5, 0.0}));
  EXPECT_EQ(law.of(0.9, 10, 29), (Restitution{0.25, 0.0}));
  EXPECT_EQ(law.of(0.9, 30, 29), rest);
  EXPECT_EQ(law.of(0.9, 60, 59), (Restitution{0.125, 2.0})) << "from a source's group";
  EXPECT_EQ(law.of(0.9, 1000, 60), rest);
  law.viscosity = 0.25;
  EXPECT_EQ(law.of(0.9, 30, 29), (Restitution{0.9, 0.25}));
}

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

Scene scene_with(const std::string& method, const std::string& physics, const std::string& rest, double t_end) {
  return parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n[physics]\n" + physics + "\n" + rest + "[run]\nmethod = \"" +
                         method + fmt::format("\"\ndt = 0.001\nt_end = {}\n", t_end),
                     "restitution.toml", "");
}

State run_to_end(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

std::string one_disk(const std::string& name, double x, double y, double vx, double vy) {
  return fmt::format(
      "[[disks]]\nname = \"{}\"\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nradius = 0.5\nmass = "
      "2.0\n",
      name, x, y, vx, vy);
}

// Two disks that meet head-on in the middle, again and again, between elastic walls: each time their speed is
// multiplied by e of twice the speed.
TEST(Viscoelastic, SpeedsOfTwoDisksFollowTheFormula) {
  constexpr double a = 0.2, least = 0.45;
  const std::string physics = fmt::format("restitution = {{ viscoelastic = {}, least = {} }}", a, least);
  const std::string two = one_disk("a", 5.0, 10.0, 600.0, 0.0) + one_disk("b", 15.0, 10.0, -600.0, 0.0);
  for (const char* method : methods) {
    Scene scene = scene_with(method, physics, two, 200.0);
    scene.run.dt = 1e-5;
    if (scene.run.method != Method::exact) scene.run.t_end = 1.5;
    const State state = run_to_end(scene);
    long double speed = 600.0L;
    bool slowest = false, formula = false;
    for (Count k = 0; k < state.counters.collisions; ++k) {
      const long double e = 1.0L - static_cast<long double>(a) * std::pow(2.0L * speed, 0.2L);
      (e < static_cast<long double>(least) ? slowest : formula) = true;
      speed *= std::max(static_cast<long double>(least), e);
    }
    EXPECT_TRUE(slowest && formula) << method;
    EXPECT_GT(state.counters.collisions, scene.run.method == Method::exact ? 12U : 4U) << method;
    const auto v = static_cast<double>(speed);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::abs(state.disks.vx[i]), v, 1e-13 * v) << method;
  }
}

// A disk of one group moves towards a disk of the other at rest; returns their speed of separation.
double separation(const std::string& method, const std::string& physics, const std::string& moving,
                  const std::string& standing) {
  const State state = run_to_end(scene_with(
      method, physics, one_disk(moving, 5.0, 10.0, 2.0, 0.0) + one_disk(standing, 8.0, 10.0, 0.0, 0.0), 2.0));
  EXPECT_EQ(state.counters.collisions, 1U);
  return std::abs(state.disks.vx[0] - state.disks.vx[1]);
}

TEST(Pairs, EachHasItsRestitution) {
  const std::string pairs = "restitution = 0.75\n[[physics.pairs]]\ngroups = [\"b\", \"a\"]\nrestitution = 0.25\n";
  for (const char* method : methods) {
    EXPECT_NEAR(separation(method, pairs, "a", "b"), 0.5, 1e-14) << method;
    EXPECT_NEAR(separation(method, pairs, "b", "a"), 0.5, 1e-14) << method;
  }
}

TEST(Pairs, OthersHaveThatOfPhysics) {
  const std::string three = one_disk("c", 18.0, 18.0, 0.0, 0.0);
  for (const char* method : methods) {
    const State state = run_to_end(
        scene_with(method, "restitution = 0.75\n[[physics.pairs]]\ngroups = [\"c\", \"a\"]\nrestitution = 0.25\n",
                   one_disk("a", 5.0, 10.0, 2.0, 0.0) + one_disk("b", 8.0, 10.0, 0.0, 0.0) + three, 2.0));
    const std::vector<std::size_t> order = by_id(state.disks);
    EXPECT_NEAR(std::abs(state.disks.vx[order[0]] - state.disks.vx[order[1]]), 1.5, 1e-14) << method;
  }
}

TEST(Pairs, HoldForFixedDisksAndForThoseOfSources) {
  const std::string peg =
      "[[disks]]\nname = \"peg\"\nfixed = true\ncount = 1\npositions = [[9.0, 10.0]]\nradius = 0.5\n";
  const std::string pegs = "[[physics.pairs]]\ngroups = [\"peg\", \"a\"]\nrestitution = 0.5\n";
  const std::string soft = "[[physics.pairs]]\ngroups = [\"a\", \"peg\"]\nrestitution = { viscoelastic = 0.25 }\n";
  const std::string source =
      "[[sources]]\nregion = [15.0, 10.0, 15.0, 10.0]\nrate = 1.0\nlimit = 1\nradius = 0.5\nmass = 2.0\n";
  const std::string sources = "[[physics.pairs]]\ngroups = [\"sources\", \"a\"]\nrestitution = 0.5\n";
  for (const char* method : methods) {
    const State state = run_to_end(scene_with(method, pegs, one_disk("a", 5.0, 10.0, 2.0, 0.0) + peg, 2.0));
    EXPECT_NEAR(state.disks.vx[0], -1.0, 1e-14) << method;
    const State slower = run_to_end(scene_with(method, soft, one_disk("a", 5.0, 10.0, 2.0, 0.0) + peg, 2.0));
    EXPECT_NEAR(slower.disks.vx[0], -2.0 * (1.0 - 0.25 * std::pow(2.0, 0.2)), 1e-14) << method;
    const State emitted = run_to_end(scene_with(method, sources, one_disk("a", 5.0, 10.0, 4.0, 0.0) + source, 2.5));
    ASSERT_EQ(emitted.disks.size(), 2U) << method;
    EXPECT_NEAR(std::abs(emitted.disks.vx[0] - emitted.disks.vx[1]), 2.0, 1e-14) << method;
  }
}

// All that depends on whether energy is lost must know of the law: piles, the TC model, the choice of a method,
// collapse.
TEST(RestitutionLaw, IsKnownToWhatAsksForDissipation) {
  const std::string two = one_disk("a", 5.0, 10.0, 2.0, 0.0) + one_disk("b", 8.0, 10.0, 0.0, 0.0);
  const std::string tc = "gravity = 1.0\ncollapse = { model = \"tc\", contact_time = 1e-3 }\n";
  const auto scene = [&](const std::string& laws) { return scene_with("exact", tc + laws, two, 2.0); };
  const Scene pairs = scene("[[physics.pairs]]\ngroups = [\"b\", \"a\"]\nrestitution = 0.25\n");
  const Scene elastic_pairs = scene("[[physics.pairs]]\ngroups = [\"b\", \"a\"]\nrestitution = 1.0\n");
  const Scene viscoelastic = scene("restitution = { viscoelastic = 0.1, least = 0.2 }\n");
  for (const Scene* s : {&pairs, &viscoelastic}) {
    EXPECT_TRUE(settles(*s));
    EXPECT_TRUE(has_tc(*s));
    EXPECT_TRUE(disks_dissipate(*s));
    const ExactRules rules = exact_rules(*s, initial_state(*s).disks, 0.0);
    EXPECT_TRUE(dissipates(rules));
    EXPECT_TRUE(may_lose_energy(rules, 0, 1));
    EXPECT_FALSE(rules.constant);
  }
  EXPECT_FALSE(settles(elastic_pairs));
  EXPECT_FALSE(has_tc(elastic_pairs));
  EXPECT_FALSE(disks_dissipate(elastic_pairs));
  EXPECT_FALSE(may_lose_energy(exact_rules(elastic_pairs, initial_state(elastic_pairs).disks, 0.0), 0, 1));
}

TEST(RestitutionLaw, SaysWhetherAGasMayCollapse) {
  const std::string gas =
      "[[disks]]\nname = \"a\"\ncount = 40\npositions = \"random\"\nvelocities = { maxwell = 1.0 }\nradius = 0.5\n"
      "mass = 1.0\n";
  const auto may = [&](const std::string& physics) {
    return scales_of(scene_with("exact", physics, gas, 1.0)).may_collapse;
  };
  EXPECT_FALSE(may(""));
  EXPECT_TRUE(may("[[physics.pairs]]\ngroups = [\"a\", \"a\"]\nrestitution = 0.3\n"));
  EXPECT_FALSE(may("restitution = { viscoelastic = 0.5 }")) << "slow disks lose nothing";
  EXPECT_FALSE(may("[[physics.pairs]]\ngroups = [\"a\", \"a\"]\nrestitution = { viscoelastic = 0.3 }\n"));
  EXPECT_TRUE(may("gravity = 1.0\nrestitution = { viscoelastic = 0.5 }"));
}

// Three disks in a row collapse for e below 7 - 4 sqrt(3).
TEST(RestitutionLaw, CollapseIsReported) {
  const std::string three =
      one_disk("a", 4.0, 10.0, 1.0, 0.0) + one_disk("b", 10.0, 10.0, 0.0, 0.0) + one_disk("c", 15.0, 10.0, -1.0, 0.0);
  const auto pairs = [](double e) {
    return fmt::format(
        "restitution = 0.9\n[[physics.pairs]]\ngroups = [\"b\", \"a\"]\nrestitution = {}\n[[physics.pairs]]\n"
        "groups = [\"b\", \"c\"]\nrestitution = {}\n",
        e, e);
  };
  EXPECT_THROW(run_to_end(scene_with("exact", pairs(0.05), three, 20.0)), PhysicsError);
  EXPECT_EQ(run_to_end(scene_with("exact", pairs(0.09), three, 20.0)).time, 20.0);
}

// Pairs with the common restitution of the scene change no bit.
TEST(Pairs, OfTheCommonRestitutionChangeNothing) {
  for (const char* method : methods) {
    for (const bool gravity : {false, true}) {
      test::Features f;
      f.method = method;
      f.gravity = gravity;
      f.restitution = 0.7;
      f.radii = "mixed";
      f.own_masses = true;
      f.obstacles = true;
      Scene plain = test::feature_scene(f, 40);
      if (plain.run.method == Method::exact) plain.physics.collapse_contact_time = 1e-3;
      Scene paired = plain;
      paired.physics.law.ends = {9, 13, 143};
      paired.physics.law.pairs = {{0, 2, {0.7, 0.0}}, {2, 2, {0.7, 0.0}}};
      const State start = initial_state(plain);
      const State a = run_to_end(plain);
      EXPECT_GT(a.counters.collisions, 50U);
      EXPECT_EQ(test::all_bits(a), test::all_bits(run_to_end(paired))) << method;
    }
  }
}

// Lengths scaled by 2^20, with a scaled by 2^-4, and so on: the same bits, scaled.
TEST(Viscoelastic, HasNoHiddenUnit) {
  for (const char* method : methods) {
    test::Features f;
    f.method = method;
    f.radii = "mixed";
    f.gravity = f.method != "exact";  // exact would collapse with it
    f.obstacles = true;
    f.law = "pairs";
    Scene scene = test::feature_scene(f, 20);
    scene.physics.restitution = 0.2;
    scene.physics.law.viscosity = 0.13;
    if (scene.run.method == Method::exact) scene.run.t_end = 0.3;
    EXPECT_GT(test::expect_same_in_all_units(scene).counters.collisions, 50U) << method;
  }
}

constexpr int steps = 12;

class RestitutionLaws : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  // Every fifth combination of features, with obstacles, with both laws in turn.
  static std::vector<test::Features> features() {
    const auto [method, sides] = GetParam();
    std::vector<test::Features> some;
    const std::vector<test::Features> all = test::all_features(method, sides);
    for (std::size_t k = std::string(sides).size() % 5; k < all.size(); k += 5) {
      if (std::string(sides) == "moving" && all[k].radii == "wide") continue;  // there is no room for large disks
      some.push_back(all[k]);
      some.back().law = k % 2 == 0 || all[k].diffusion == "replace" ? "pairs" : "viscoelastic";
      some.back().obstacles = k % 3 != 0;
    }
    return some;
  }
  static Scene scene_of(const test::Features& f) {
    Scene scene = test::feature_scene(f, steps);
    if (f.method == "exact" && (f.gravity || f.seed % 4 != 0)) scene.physics.collapse_contact_time = 1e-3;
    return scene;
  }
};

TEST_P(RestitutionLaws, BitsOfTheReferenceOnAnyThreads) {
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    ASSERT_NE(law_of(scene), nullptr);
    const State start = initial_state(scene);
    test::expect_bits_of_reference(scene, start, steps);
  }
}

TEST_P(RestitutionLaws, ResumedRunsHaveTheSameBits) {
  int first = 0;
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    test::expect_same_bits(scene, initial_state(scene), steps, first++);
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, RestitutionLaws,
                         ::testing::Combine(::testing::ValuesIn(methods), ::testing::Values("moving")),
                         test::method_and_sides);
INSTANTIATE_TEST_SUITE_P(LongAllMethods, RestitutionLaws,
                         ::testing::Combine(::testing::ValuesIn(methods),
                                            ::testing::Values("wall", "periodic", "sink")),
                         test::method_and_sides);

}  // namespace
}  // namespace carom
