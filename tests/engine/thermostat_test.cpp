// Thermostats: disks reach the canonical ensemble of the given temperature, and the balance of energy holds.
#include "core/step/thermostat.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/load/scene_file.hpp"
#include "core/measure/energy_gain.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/run_start.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"

namespace carom {
namespace {

constexpr const char* kinds[] = {"langevin", "andersen"};
constexpr const char* methods[] = {"exact", "pairwise", "rollback"};

struct Bath {
  std::string method = "exact", kind = "langevin";
  double temperature = 2.0, rate = 1.0, restitution = 1.0, side = 16.0, t_end = 10.0;
  int disks = 64;
};

Scene scene_of(const Bath& b) {
  return parse_scene(
      fmt::format("[box]\nwidth = {0}\nheight = {0}\nleft = \"periodic\"\nright = \"periodic\"\n[physics]\n"
                  "restitution = {1}\nthermostat = {{ kind = \"{2}\", temperature = {3}, rate = {4}, dt = 0.2 }}\n"
                  "[[disks]]\ncount = {5}\npositions = \"random\"\nvelocities = {{ maxwell = 10.0 }}\nradius = 0.4\n"
                  "mass = {{ uniform = [1, 3] }}\n[run]\nmethod = \"{6}\"\ndt = 0.01\nt_end = {7}\n",
                  b.side, b.restitution, b.kind, b.temperature, b.rate, b.disks, b.method, b.t_end),
      "bath.toml", "");
}

struct Sampled {
  double mean = 0.0, variance = 0.0;  // of the kinetic energy
  double x_share = 0.0;               // share of the motion along x, the direction of the walls
};

// Samples of the kinetic energy `every` apart, from time `from` on.
Sampled sample(Engine& engine, const Scene& scene, double from, double every) {
  std::vector<double> kinetic;
  double along_x = 0.0, total = 0.0;
  for (double t = from; t < scene.run.t_end; t += every) {
    while (engine.state().time < t) engine.step();
    const Disks& d = engine.state().disks;
    kinetic.push_back(energy_of(d, 0.0).kinetic);
    total += kinetic.back();
    for (std::size_t i = 0; i < d.size(); ++i) along_x += 0.5 * d.mass_of(i) * d.vx[i] * d.vx[i];
  }
  Sampled s;
  const auto n = static_cast<double>(kinetic.size());
  s.mean = total / n;
  for (const double k : kinetic) s.variance += (k - s.mean) * (k - s.mean) / (n - 1.0);
  s.x_share = along_x / total;
  return s;
}

TEST(Kick, KeepsMaxwellsDistribution) {
  for (const double x : {1e-6, 0.1, 0.5, 1.0}) {
    const Kick kick = langevin_kick(x, 1.0);
    EXPECT_NEAR(kick.kept * kick.kept + kick.drawn * kick.drawn, 1.0, 1e-15);
    EXPECT_NEAR(kick.kept, std::exp(-x), x * x * x / 12.0 + 1e-15);
  }
}

// In a shear a kick acts on the velocity relative to the flow, vx = g (y - h / 2): without noise it halves that.
TEST(Kick, IsRelativeToTheFlow) {
  Scene scene = test::scene_of(Method::exact, 10.0, 8.0, 0.0, 1.0);
  scene.box.sides.fill(SideKind::periodic);
  scene.box.shear.rate = 0.5;
  scene.physics.thermostat = {Thermostat::Kind::langevin, 1.0, 1.0, 0.1};
  Disks d = test::disks_of({{2.0, 7.0, 4.0, 3.0, 1.0, 2.0}});
  const double given = with_view(d, [&](const auto& view) {
    return kick_disk(view, scene, {0.5, 0.0}, 0, {1.0, 1.0});
  });
  EXPECT_EQ(d.vx[0], 1.5 + 0.5 * (4.0 - 1.5));
  EXPECT_EQ(d.vy[0], 1.5);
  EXPECT_DOUBLE_EQ(given, 2.75 * 2.75 + 1.5 * 1.5 - (16.0 + 9.0)) << "in the laboratory frame, with a mass of 2";
}

// Kick k is due at k dt, also if the time of a step is a little before that by rounding, 1e-12 of it.
TEST(Kick, IsDueButForRounding) {
  Scene scene = test::scene_of(Method::pairwise, 10.0, 8.0, 0.1, 10.0);
  scene.physics.thermostat = {Thermostat::Kind::langevin, 1.0, 1.0, 0.3};
  State state;
  EXPECT_TRUE(is_kick_due(scene, state)) << "the first kick is due at 0";
  state.intervals = 7;
  for (const auto& [time, due] : {std::pair(2.1, true), std::pair(2.1 * (1.0 - 1e-14), true), std::pair(2.2, true),
                                  std::pair(2.1 * (1.0 - 1e-11), false), std::pair(2.0, false)}) {
    state.time = time;
    EXPECT_EQ(is_kick_due(scene, state), due) << time;
  }
}

// N disks have 2 N degrees of freedom: the kinetic energy has the mean N T and the variance N T^2. In an isolated gas
// it has no variance.
TEST(LongThermostat, GivesTheCanonicalEnsemble) {
  for (const char* method : {"exact", "pairwise"}) {
    for (const char* kind : kinds) {
      Bath b;
      b.method = method;
      b.kind = kind;
      b.t_end = std::string(method) == "exact" ? 1500.0 : 400.0;
      const Scene scene = scene_of(b);
      const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
      const Sampled s = sample(*engine, scene, 30.0, 2.0);
      const double samples = (b.t_end - 30.0) / 2.0;
      const double n = b.disks, t = b.temperature;
      SCOPED_TRACE(fmt::format("{} {}", method, kind));
      EXPECT_NEAR(s.mean / (n * t), 1.0, 5.0 / std::sqrt(n * samples));
      EXPECT_NEAR(s.variance / (n * t * t), 1.0, 5.0 * std::sqrt(2.0 / samples));
      EXPECT_NEAR(s.x_share, 0.5, 5.0 / std::sqrt(4.0 * n * samples));
    }
  }
}

// Elastic disks: the energy gained is that from the thermostat.
TEST(Thermostat, BooksItsHeat) {
  for (const char* method : methods) {
    for (const char* kind : kinds) {
      Bath b;
      b.method = method;
      b.kind = kind;
      b.t_end = 20.0;
      const Scene scene = scene_of(b);
      const State start = initial_state(scene);
      const auto engine = make_parallel_engine(scene, start, {2, 1});
      while (engine->state().time < scene.run.t_end) engine->step();
      const double before = energy_of(start.disks, 0.0).kinetic, after = energy_of(engine->state().disks, 0.0).kinetic;
      const double heat = engine->state().counters.thermostat_heat;
      EXPECT_LT(heat, -0.5 * before) << "the thermostat must cool the disks";
      EXPECT_NEAR((before + heat) / after, 1.0, 1e-11) << method << " " << kind;
      EXPECT_TRUE(energy_warnings(scene, run_start(start, scene), engine->state()).empty());
    }
  }
}

// Kicks are at 0, dt, 2 dt and so on, and none is at t_end, although by rounding 3 times 0.3 is less than 0.9, and 3
// times 0.1 more than 0.3: all methods end with the same velocities.
TEST(Thermostat, GivesNoKickAtTheEnd) {
  const std::vector<Disk> free_disks = {{10.0, 10.0, 1.0, 0.0, 0.5, 1.0}, {40.0, 40.0, 0.0, 1.0, 0.5, 1.0}};
  struct Case {
    double dt, t_end;
    Count kicks;
  };
  for (const Case& c :
       {Case{0.3, 0.9, 3}, {0.3, 2.7, 9}, {0.7, 2.1, 3}, {0.1, 0.3, 3}, {0.25, 1.0, 4}, {0.3, 1.0, 4}}) {
    std::vector<std::vector<double>> velocities;
    for (const Method method : {Method::exact, Method::pairwise, Method::rollback}) {
      Scene scene = test::scene_of(method, 50.0, 50.0, method == Method::exact ? 0.0 : c.dt / 8.0, c.t_end);
      test::set_sides(scene.box, SideKind::periodic, SideKind::periodic);
      scene.physics.thermostat = {Thermostat::Kind::langevin, 1.0, 0.5, c.dt};
      const State start = test::state_of(scene, free_disks);
      for (const bool reference : {true, false}) {
        const auto engine =
            reference ? make_reference_engine(scene, start) : make_parallel_engine(scene, start, {1, 1});
        while (engine->state().time < scene.run.t_end) engine->step();
        EXPECT_EQ(engine->state().intervals, c.kicks) << c.dt << " to " << c.t_end;
        velocities.push_back(engine->state().disks.vx);
      }
    }
    for (const std::vector<double>& v : velocities) EXPECT_EQ(v, velocities[0]) << c.dt << " to " << c.t_end;
  }
}

// Driven inelastic disks are colder than the thermostat. Their temperature is such that collisions, each of which loses
// (1 - e^2) T on average (for Maxwell's distribution), lose what the thermostat gives. Equal masses.
TEST(Thermostat, BalancesWhatCollisionsLose) {
  Bath b;
  b.restitution = 0.9;
  b.disks = 200;
  b.t_end = 330.0;
  Scene scene = scene_of(b);
  scene.groups[0].mass = SizeLaw{};
  scene.groups[0].mass.value = 1.0;
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  while (engine->state().time < 30.0) engine->step();
  const Counters before = engine->state().counters;
  const Sampled s = sample(*engine, scene, 30.0, 0.4);
  const Counters& after = engine->state().counters;
  // Samples are taken where the energy is lowest, just before a kick; adding half a kick gives the mean.
  const double heat = after.thermostat_heat - before.thermostat_heat;
  const double kicks = (b.t_end - 30.0) / 0.2;
  const double temperature = (s.mean + 0.5 * heat / kicks) / b.disks;
  EXPECT_LT(temperature, 0.9 * b.temperature);
  const double lost =
      static_cast<double>(after.collisions - before.collisions) * (1.0 - b.restitution * b.restitution) * temperature;
  std::printf("temperature %.3f of the bath's, heat over what collisions lose %.4f\n", temperature / b.temperature,
              heat / lost);
  EXPECT_NEAR(heat / lost, 1.0, 0.05);  // velocities before collisions are slightly correlated
}

}  // namespace
}  // namespace carom
