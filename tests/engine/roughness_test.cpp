// Rough disks in all three methods: single contacts in a run, conservation, the same bits from both engines on any
// number of threads and after resume, smooth surfaces that change nothing, and no hidden unit.
#include "core/physics/roughness.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "core/measure/energy_gain.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/run_start.hpp"
#include "core/step/step_start.hpp"
#include "core/step/window_plan.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/resume_support.hpp"
#include "tests/support/run_in_all_units.hpp"
#include "tests/support/state_bits.hpp"

namespace carom {
namespace {

constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

Scene scene_with(const std::string& method, const std::string& box, const std::string& physics, const std::string& rest,
                 double t_end) {
  return parse_scene("[box]\nwidth = 20.0\nheight = 20.0\n" + box + "[physics]\n" + physics + "\n" + rest +
                         "[run]\nmethod = \"" + method + fmt::format("\"\ndt = 0.001\nt_end = {}\n", t_end),
                     "rough.toml", "");
}

State run_to_end(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {2, 1});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

std::string one_disk(double x, double y, double vx, double vy, double spin) {
  return fmt::format(
      "[[disks]]\ncount = 1\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\nspin = {}\nradius = 0.5\nmass = 2.0\n", x,
      y, vx, vy, spin);
}

// Two disks meet head-on, and the first spins: the slip is -w r = -3, and a third of its change becomes an impulse of 2
// reduced masses.
TEST(RoughDisks, MeetHeadOnWithSpin) {
  for (const char* method : methods) {
    const State s =
        run_to_end(scene_with(method, "", "roughness = { tangential_restitution = 1.0 }",
                              one_disk(5.0, 10.0, 1.0, 0.0, 6.0) + one_disk(8.0, 10.0, -1.0, 0.0, 0.0), 2.0));
    ASSERT_EQ(s.counters.collisions, 1U);
    const std::vector<std::size_t> at = by_id(s.disks);
    EXPECT_NEAR(s.disks.vx[at[0]], -1.0, 1e-12) << method;
    EXPECT_NEAR(s.disks.vy[at[0]], -1.0, 1e-12) << method;
    EXPECT_NEAR(s.disks.vy[at[1]], 1.0, 1e-12) << method;
    EXPECT_NEAR(s.disks.spin[at[0]], 2.0, 1e-11) << method;
    EXPECT_NEAR(s.disks.spin[at[1]], -4.0, 1e-11) << method;
  }
}

// A disk flies to the right wall, with equal velocities along and across it. Sticking, b = 0.5 takes half of the speed
// along the wall; with mu = 0.125 and e = 1 sliding takes 0.25.
TEST(RoughWalls, TakeUpSpeedBySpin) {
  const std::string disk = one_disk(18.0, 5.0, 1.0, 1.0, 0.0);
  for (const char* method : methods) {
    const auto end = [&](const std::string& box) {
      return run_to_end(scene_with(method, box, "roughness = { tangential_restitution = 0.5 }", disk, 2.0)).disks;
    };
    const Disks smooth = end("");
    EXPECT_EQ(smooth.vy[0], 1.0) << "walls are smooth unless the scene says otherwise";
    EXPECT_EQ(smooth.spin[0], 0.0);
    const Disks sticking = end("wall_roughness = { tangential_restitution = 0.5 }\n");
    EXPECT_NEAR(sticking.vy[0], 0.5, 1e-13) << method;  // 1 - 1.5 / 3
    EXPECT_NEAR(sticking.spin[0], -2.0, 1e-13)
        << method;  // 0.5 / (0.5 0.5), clockwise, as it rolls up the wall to its right
    const Disks sliding = end("wall_roughness = { tangential_restitution = 0.5, friction = 0.125 }\n");
    EXPECT_NEAR(sliding.vy[0], 0.75, 1e-13) << method;
    EXPECT_NEAR(sliding.spin[0], -1.0, 1e-13) << method;
  }
}

// Inner walls are as rough as sides, and fixed disks as rough as other disks.
TEST(RoughObstacles, AreAsRoughAsWallsOrDisks) {
  const std::string wall = "[[walls]]\nfrom = [10.0, 2.0]\nto = [10.0, 18.0]\n";
  const std::string peg = "[[disks]]\nfixed = true\ncount = 1\npositions = [[10.0, 10.0]]\nradius = 0.5\n";
  for (const char* method : methods) {
    const auto end = [&](const std::string& box, const std::string& disk, const std::string& obstacle) {
      return run_to_end(scene_with(method, box, "roughness = { tangential_restitution = 0.5 }", disk + obstacle, 2.0))
          .disks;
    };
    const Disks off_wall =
        end("wall_roughness = { tangential_restitution = 0.0 }\n", one_disk(8.5, 5.0, 1.0, 1.0, 0.0), wall);
    EXPECT_NEAR(off_wall.vx[0], -1.0, 1e-12) << method;
    EXPECT_NEAR(off_wall.vy[0], 2.0 / 3.0, 1e-12) << method;
    EXPECT_NEAR(off_wall.spin[0], -4.0 / 3.0, 1e-12) << method;
    EXPECT_EQ(end("", one_disk(8.5, 5.0, 1.0, 1.0, 0.0), wall).spin[0], 0.0) << method;
    const Disks off_peg = end("", one_disk(8.0, 10.0, 1.0, 0.0, 6.0), peg);
    EXPECT_NEAR(off_peg.vx[0], -1.0, 1e-12) << method;
    EXPECT_NEAR(off_peg.vy[0], -1.5, 1e-12)
        << method;  // its surface moves up at 3, so it is pushed down by 1.5 / 3 of that
    EXPECT_NEAR(off_peg.spin[0], 0.0, 1e-12) << method;
  }
}

test::Features gas(const std::string& method, const std::string& rough) {
  test::Features f;
  f.method = method;
  f.sides = "periodic";
  f.radii = "mixed";
  f.own_masses = true;
  f.rough = rough;
  return f;
}

// Perfectly rough and elastic disks conserve momentum and the sum of both energies. With inelastic ones the energy
// falls.
TEST(RoughGas, KeepsEnergyAndMomentum) {
  for (const char* method : {"exact", "pairwise"}) {
    Scene scene = test::feature_scene(gas(method, "sticking"), 60);
    if (scene.run.method != Method::exact) scene.run.dt = 1e-3;
    const State lossy = run_to_end(scene);
    scene.physics.surfaces.disks.restitution = 1.0;
    const State start = initial_state(scene);
    const Energy before = energy_of(start.disks, 0.0);
    EXPECT_GT(before.rotational, 0.0);
    const State end = run_to_end(scene);
    const Energy after = energy_of(end.disks, 0.0);
    EXPECT_GT(end.counters.collisions, 300U);
    EXPECT_NE(after.rotational, before.rotational);
    EXPECT_NEAR(after.total() / before.total(), 1.0, 1e-13) << method;
    EXPECT_LT(momentum_drift(momentum_of(start.disks), momentum_of(end.disks)), 1e-13) << method;
    EXPECT_TRUE(energy_warnings(scene, run_start(start, scene), end).empty());
    EXPECT_LT(energy_of(lossy.disks, 0.0).total(), 0.95 * before.total()) << method;
  }
}

// Thermal sides give heat to the spin, too, if walls are rough, and the spin reaches their temperature.
TEST(RoughGas, IsHeatedByThermalSides) {
  for (const char* method : methods) {
    test::Features f = gas(method, "sticking");
    f.sides = "hot";
    Scene scene = test::feature_scene(f, 200);
    scene.physics.surfaces.disks.restitution = 1.0;
    for (const bool rough_walls : {false, true}) {
      if (rough_walls) scene.physics.surfaces.walls = {1.0, HUGE_VAL};
      const State start = initial_state(scene);
      const State end = run_to_end(scene);
      double heat = 0.0;
      for (const double h : end.counters.side_energy) heat += h;
      const double before = energy_of(start.disks, 0.0).total();
      EXPECT_GT(std::abs(heat), 0.0);
      EXPECT_NEAR((before + heat) / energy_of(end.disks, 0.0).total(), 1.0, 1e-12) << method << rough_walls;
    }
  }
}

// With b = -1 or mu = 0 positions, velocities and counters are those of smooth disks, bit for bit, and spins do not
// change.
TEST(SmoothSurfaces, ChangeNoBit) {
  for (const char* method : methods) {
    for (const bool gravity : {false, true}) {
      test::Features f = gas(method, "sliding");
      f.sides = "wall";
      f.gravity = gravity;
      f.obstacles = true;
      Scene rough = test::feature_scene(f, 40);
      Scene plain = rough;
      plain.physics.surfaces = {};
      const State a = run_to_end(plain);
      EXPECT_GT(a.counters.collisions, 50U);
      for (const Roughness smooth : {Roughness{-1.0, HUGE_VAL}, Roughness{0.5, 0.0}}) {
        rough.physics.surfaces.disks = rough.physics.surfaces.walls = smooth;
        State b = run_to_end(rough);
        const std::vector<std::size_t> at = by_id(b.disks);
        const State start = initial_state(rough);
        for (const std::size_t i : at) EXPECT_EQ(b.disks.spin[i], start.disks.spin[b.disks.id[i] - start.disks.id[0]]);
        b.disks.spin.clear();
        b.disks.inertia = 0.0;
        EXPECT_EQ(test::all_bits(b), test::all_bits(a)) << method;
      }
    }
  }
}

// A contact that the TC model makes elastic is smooth, too: a disk between two walls that come closer and closer.
TEST(RoughDisks, AreSmoothWhereTheTcModelMakesThemElastic) {
  Scene scene = scene_with("exact", "wall_roughness = { tangential_restitution = 0.5 }\nwall_restitution = 0.5\n",
                           "roughness = { tangential_restitution = 0.5 }\n"
                           "collapse = { model = \"tc\", contact_time = 100.0 }",
                           one_disk(18.0, 5.0, 1.0, 1.0, 0.0), 95.0);
  const State s = run_to_end(scene);
  EXPECT_GT(s.counters.wall_collisions, 2U);
  EXPECT_NEAR(std::abs(s.disks.spin[0]), 2.0, 1e-13) << "only the first contact was rough";
  EXPECT_GT(s.validity.inaccurate, 0U);
}

TEST(RoughDisks, AreKnownToWhatAsksForDissipation) {
  const auto scene = [](const std::string& roughness) {
    return scene_with("exact", "", "gravity = 1.0\ncollapse = { model = \"tc\", contact_time = 1e-3 }\n" + roughness,
                      one_disk(5.0, 10.0, 1.0, 0.0, 0.0), 1.0);
  };
  const Scene lossy = scene("roughness = { tangential_restitution = 0.5 }");
  const Scene sliding = scene("roughness = { tangential_restitution = 1.0, friction = 0.5 }");
  const Scene perfect = scene("roughness = { tangential_restitution = 1.0 }");
  const Scene smooth = scene("roughness = { tangential_restitution = -1.0 }");
  for (const Scene* s : {&lossy, &sliding}) {
    EXPECT_TRUE(settles(*s) && has_tc(*s) && disks_dissipate(*s));
    const ExactRules rules = exact_rules(*s, initial_state(*s).disks, 0.0);
    EXPECT_TRUE(dissipates(rules) && may_lose_energy(rules, 0, 1));
    EXPECT_FALSE(may_lose_energy(rules, 0, wall_partner(Side::left)));
  }
  for (const Scene* s : {&perfect, &smooth}) {
    EXPECT_FALSE(settles(*s) || has_tc(*s) || disks_dissipate(*s));
    EXPECT_FALSE(dissipates(exact_rules(*s, initial_state(*s).disks, 0.0)));
  }
}

TEST(RoughDisks, HaveNoHiddenUnit) {
  for (const char* method : methods) {
    for (const char* kind : {"sticking", "sliding"}) {
      test::Features f = gas(method, kind);
      f.sides = "hot";
      f.gravity = true;
      f.restitution = 0.7;
      f.source = true;
      Scene scene = test::feature_scene(f, 20);
      scene.title = f.name();
      const State end = test::expect_same_in_all_units(scene);
      EXPECT_GT(end.counters.collisions, 20U);
    }
  }
}

// A frame within a window of exact has the spins of that time, in both engines.
TEST(RoughDisks, AreSeenWithTheirSpinWithinAWindow) {
  test::Features f = gas("exact", "sliding");
  f.sides = "sink";
  const Scene scene = test::feature_scene(f, 100);
  const State start = initial_state(scene);
  for (const int threads : {1, 3}) {
    const auto engine = make_parallel_engine(scene, start, {threads, 512});
    const auto twin = make_reference_engine(scene, start);
    for (int k = 0; k < 6; ++k) {
      const double before = engine->state().time;
      engine->step();
      twin->step();
      for (const double share : {0.0, 0.3, 0.8, 1.0}) {
        State a, b;
        const double t = before + share * (engine->state().time - before);
        EXPECT_EQ(engine->disks_at(t, a.disks), twin->disks_at(t, b.disks));
        ASSERT_EQ(test::all_bits(a), test::all_bits(b)) << k << " " << share;
        EXPECT_TRUE(a.disks.spins() || a.disks.empty());
      }
    }
  }
}

constexpr int steps = 12;

class Roughnesses : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  // Every fifth combination of features without Brownian motion, sticking and sliding in turn, in some cases with a law
  // of restitution.
  static std::vector<test::Features> features() {
    const auto [method, sides] = GetParam();
    std::vector<test::Features> some;
    std::vector<test::Features> all = test::all_features(method, sides);
    std::erase_if(all, [](const test::Features& f) { return !f.diffusion.empty(); });
    for (std::size_t k = std::string(sides).size() % 3; k < all.size(); k += 5) {
      if (std::string(sides) == "moving" && all[k].radii == "wide") continue;  // there is no room for large disks
      some.push_back(all[k]);
      some.back().rough = some.size() % 2 == 0 ? "sticking" : "sliding";
      some.back().law = some.size() % 3 == 0 ? "viscoelastic" : some.size() % 5 == 0 ? "pairs" : "";
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

TEST_P(Roughnesses, BitsOfTheReferenceOnAnyThreads) {
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    const State start = initial_state(scene);
    ASSERT_TRUE(start.disks.spins());
    test::expect_bits_of_reference(scene, start, steps);
  }
}

TEST_P(Roughnesses, ResumedRunsHaveTheSameBits) {
  int first = 0;
  for (const test::Features& f : features()) {
    SCOPED_TRACE(f.name());
    const Scene scene = scene_of(f);
    test::expect_same_bits(scene, initial_state(scene), steps, first++);
  }
}

INSTANTIATE_TEST_SUITE_P(AllMethods, Roughnesses,
                         ::testing::Combine(::testing::Values("pairwise", "rollback", "exact"),
                                            ::testing::Values("moving", "hot")),
                         test::method_and_sides);
INSTANTIATE_TEST_SUITE_P(LongAllMethods, Roughnesses,
                         ::testing::Combine(::testing::Values("pairwise", "rollback", "exact"),
                                            ::testing::Values("wall", "periodic", "sink")),
                         test::method_and_sides);

}  // namespace
}  // namespace carom
