// The TC model changes nothing if nothing dissipates; energy that a run has gained is reported at its end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/disks/state.hpp"
#include "core/load/scene_warnings.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/scene/scene.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/exact_support.hpp"
#include "tests/support/program_support.hpp"

namespace carom::exact_tests {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string slow_gas =
    "[[disks]]\ncount = 100\npositions = \"square\"\nvelocities = { maxwell = 0.05 }\nradius = 0.5\nmass = 1.0\n";

Scene gas_scene(double restitution, double contact_time) {
  return make_scene({40, 40, "wall",
                     "gravity = 1.0\nrestitution = " + std::to_string(restitution) +
                         "\ncollapse = { model = \"tc\", contact_time = " + std::to_string(contact_time) + " }",
                     slow_gas, 60.0, ""});
}

double gain(const Scene& scene, const State& start, const State& end) {
  const double before = energy_of(start.disks, scene.physics.gravity).total();
  return energy_of(end.disks, scene.physics.gravity).total() / before - 1.0;
}

State run_both(const Scene& scene, const State& start) {
  const State plain = run_reference(scene, start);
  const auto parallel = make_parallel_engine(scene, start, {2, 512});
  run_to_end(*parallel, scene);
  EXPECT_EQ(state_hash(parallel->state().disks), state_hash(plain.disks));
  return plain;
}

TEST(TcEnergy, AnElasticGasUnderGravityKeepsItsEnergy) {
  Scene scene = gas_scene(1.0, 10.0);
  const State start = initial_state(scene);
  const State end = run_both(scene, start);
  EXPECT_NEAR(gain(scene, start, end), 0.0, 1e-12);
  EXPECT_THAT(energy_warnings(scene, run_start(start, scene), end), IsEmpty());
  EXPECT_THAT(scene_warnings(scene),
              ElementsAre(HasSubstr("physics.collapse: restitution and wall_restitution are 1")));
  scene.physics.collapse_contact_time.reset();
  EXPECT_EQ(state_hash(run_reference(scene, start).disks), state_hash(end.disks));
}

// contact_time is so long that all but the first collisions are elastic, and hops on the floor are faster than the gas.
TEST(TcEnergy, AGasThatIsHeatedByItsHopsWarns) {
  const Scene scene = gas_scene(0.9, 10.0);
  const State start = initial_state(scene);
  const State end = run_both(scene, start);
  EXPECT_GT(gain(scene, start, end), 0.01);
  EXPECT_THAT(scene_warnings(scene), IsEmpty());
  EXPECT_THAT(energy_warnings(scene, run_start(start, scene), end),
              ElementsAre(AllOf(HasSubstr("was put in"), HasSubstr("contact_time = 10 is long"))));
}

// In the TC model a disk lying on the floor hops, with an energy of m (g t_c)^2 / 32: negligible for a short contact
// time, reported for a long one.
TEST(TcEnergy, EnergyGainIsReported) {
  Domain box;
  box.width = box.height = 10.0;
  box.restitutions.fill(0.5);
  Scene scene = plain_scene(box, 20.0, 1.0);
  const State start = state_of({{5, 1, 0, 0, 1, 1, 0}});
  for (const double contact_time : {1e-4, 1.0}) {
    scene.physics.collapse_contact_time = contact_time;
    const State end = run_both(scene, start);
    const std::vector<std::string> warnings = energy_warnings(scene, run_start(start, scene), end);
    if (contact_time < 1.0) {
      EXPECT_THAT(warnings, IsEmpty());
    } else {
      EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("the energy is 1.03125, but only 1 was put in"),
                                              HasSubstr("contact_time = 1 is long"))));
    }
  }
}

TEST(TcEnergy, EnergyFromSourcesAndBrownianMotionIsNoGain) {
  for (const std::string method : {"exact", "pairwise", "rollback"}) {
    Scene scene = make_scene({20, 20, "wall", "gravity = 0.2",
                              "[[sources]]\nside = \"top\"\nrate = 5\nradius = 0.3\nmass = 2\n"
                              "velocities = { maxwell = 1.0 }\n",
                              4.0, "dt = 0.005\n"});
    scene.run.method = method == "exact" ? Method::exact : method == "pairwise" ? Method::pairwise : Method::rollback;
    const State start = initial_state(scene);
    const auto engine = make_parallel_engine(scene, start, {1});
    run_to_end(*engine, scene);
    EXPECT_GE(engine->state().counters.emitted, 15U);
    EXPECT_NEAR(energy_of(engine->state().disks, 0.2).total() / engine->state().counters.emitted_energy, 1.0, 1e-3);
    EXPECT_THAT(energy_warnings(scene, run_start(start, scene), engine->state()), IsEmpty()) << method;
    State more = engine->state();
    more.disks.vx[0] += 50.0;
    EXPECT_THAT(energy_warnings(scene, run_start(start, scene), more), ElementsAre(HasSubstr("was put in: ")))
        << method;
    scene.physics.diffusion = 1.0;
    EXPECT_THAT(energy_warnings(scene, run_start(start, scene), more), IsEmpty());
  }
}

using TcEnergyRun = test::ProgramTest;

TEST_F(TcEnergyRun, IsWarnedOfAndEndsAStrictRun) {
  write("rest.toml",
        "[box]\nwidth = 10\nheight = 10\nwall_restitution = 0.5\n[physics]\ngravity = 1\n"
        "collapse = { model = \"tc\", contact_time = 1.0 }\n[[disks]]\ncount = 1\npositions = [[5, 1]]\nradius = 1\n"
        "mass = 1\n[run]\nt_end = 1\n");
  const test::Outcome o = carom("run rest.toml --json");
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("warning: at the end, at time 1, the energy is 1.03125"));
  EXPECT_THAT(nlohmann::json::parse(o.out)["warnings"].dump(), HasSubstr("the energy is 1.03125"));
  const test::Outcome strict = carom("run rest.toml --strict");
  EXPECT_EQ(strict.status, 3);
  EXPECT_THAT(strict.err, HasSubstr("(--strict)"));
}

// The potential energy is negative if gravity pulls to the right or up; along periodic sides disks gain energy by
// falling, and a disk that leaves may take negative energy with it. None of this is a gain to be reported.
TEST(TcEnergy, GravityInAnyDirectionIsNoGain) {
  const std::string disks =
      "[[disks]]\ncount = 20\npositions = \"square\"\nvelocities = { maxwell = 0.5 }\n"
      "radius = 0.5\nmass = 1.0\n";
  for (const std::string gravity : {"[1.5, 0.0]", "[-1.5, 0.0]", "[0.0, 1.5]", "[1.0, 1.0]", "[0.5, -1.0]"}) {
    for (const std::string sides : {"wall", "sink", "periodic"}) {
      for (const Method method : {Method::exact, Method::pairwise}) {
        Scene scene = make_scene({20, 20, sides, "gravity = " + gravity, disks, 20.0, "dt = 0.005\n"});
        scene.run.method = method;
        const State start = initial_state(scene);
        const auto engine = make_parallel_engine(scene, start, {1});
        run_to_end(*engine, scene);
        EXPECT_THAT(energy_warnings(scene, run_start(start, scene), engine->state()), IsEmpty()) << gravity << sides;
        if (sides != "wall") continue;
        State more = engine->state();
        more.disks.vx[0] += 50.0;
        EXPECT_THAT(energy_warnings(scene, run_start(start, scene), more), ElementsAre(HasSubstr("was put in: ")));
      }
    }
  }
}

}  // namespace
}  // namespace carom::exact_tests
