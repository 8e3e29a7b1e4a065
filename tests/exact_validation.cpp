// The exact method against published physics (references.md): equation of state and collision rate, granular cooling,
// the barometric formula, absorption, and what must be conserved over long runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exact_support.hpp"
#include "parallel/simulation.hpp"

namespace carom::exact_tests {
namespace {

struct Measured {
  double mean = 0.0, error = 0.0;  // of the mean
};

Measured from_blocks(const std::vector<double>& blocks) {
  const auto n = static_cast<double>(blocks.size());
  Measured m;
  for (const double b : blocks) m.mean += b / n;
  double squares = 0.0;
  for (const double b : blocks) squares += (b - m.mean) * (b - m.mean);
  m.error = std::sqrt(squares / (n * (n - 1.0)));
  return m;
}

Scene gas(int n, double eta, double t_end, const std::string& physics = "") {
  const std::string text = fmt::format(
      "[box]\npacking_fraction = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = "
      "\"periodic\"\n"
      "[physics]\n{}\n[[disks]]\ncount = {}\npositions = \"hexagonal\"\nvelocities = {{ maxwell = 1.0 }}\nradius = "
      "0.5\n"
      "mass = 1.0\n[run]\nmethod = \"exact\"\nt_end = {}\n",
      eta, physics, n, t_end);
  return parse_scene(text, "test", ".");
}

void run_until(Engine& engine, double t) {
  while (engine.state().time < t) engine.step();
}

struct StateCase {
  double eta, z, z_error;
  int n;
};

class ExactEquationOfState : public testing::TestWithParam<StateCase> {};

// Z from the virial of the collisions and from their number, each in blocks of 50 collisions a disk after as many to
// forget the lattice. Finite size: (Z - 1) / N.
TEST_P(ExactEquationOfState, VirialAndRateAgreeWithTheTable) {
  const StateCase c = GetParam();
  const double n = c.n;
  const double rate = 4.0 * (c.z - 1.0) / std::sqrt(std::numbers::pi);
  constexpr int blocks = 16;
  const double block = 50.0 / rate;
  const Scene scene = gas(c.n, c.eta, block * (blocks + 2));
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  const double kt = energy_of(engine->state().disks, 0.0).kinetic / (n - 1.0);
  run_until(*engine, block);
  std::vector<double> virial;
  std::vector<double> counted;
  for (int k = 0; k < blocks; ++k) {
    const double start = engine->state().time;
    const Counters before = engine->state().counters;
    run_until(*engine, start + block);
    const double elapsed = engine->state().time - start;
    const Counters& after = engine->state().counters;
    virial.push_back(1.0 + (after.virial - before.virial) / (2.0 * elapsed * n * kt));
    const double gamma = 2.0 * static_cast<double>(after.collisions - before.collisions) / (n * elapsed);
    counted.push_back(1.0 + gamma * std::sqrt(std::numbers::pi / kt) / 4.0);
  }
  const Measured zv = from_blocks(virial);
  const Measured zr = from_blocks(counted);
  const double size = (c.z - 1.0) / n;
  fmt::print("eta {:.2f} N {} Z virial {:.5f} +- {:.5f}, rate {:.5f} +- {:.5f}, published {:.5f}\n", c.eta, c.n,
             zv.mean, zv.error, zr.mean, zr.error, c.z);
  EXPECT_NEAR(zv.mean, c.z, 3.0 * std::hypot(zv.error, c.z_error) + size);
  EXPECT_NEAR(zr.mean, c.z, 3.0 * std::hypot(zr.error, c.z_error) + size);
  EXPECT_LT(zv.error, 0.01 * c.z) << "too short to say anything";
}

INSTANTIATE_TEST_SUITE_P(Table, ExactEquationOfState,
                         testing::Values(StateCase{0.05, 1.108388, 1e-6, 400}, StateCase{0.10, 1.236144, 1e-6, 400},
                                         StateCase{0.30, 2.06326, 5e-5, 400}, StateCase{0.50, 4.105, 2e-3, 400},
                                         StateCase{0.67, 9.36234, 3e-5, 870}));

// T = T0 / (1 + t / tau)^2 while the gas stays uniform.
TEST(ExactHaff, CoolsAsItShould) {
  const double gamma0 = 4.0 * 0.236144 / std::sqrt(std::numbers::pi);
  const double e = 0.98;
  const double tau = 4.0 / ((1.0 - e * e) * gamma0);
  const Scene scene = gas(1024, 0.1, 4.7 * tau, fmt::format("restitution = {}", e));
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  const double before = energy_of(engine->state().disks, 0.0).kinetic;
  run_until(*engine, scene.run.t_end);
  const double ratio = energy_of(engine->state().disks, 0.0).kinetic / before;
  EXPECT_NEAR(ratio * 5.7 * 5.7, 1.0, 0.03);
}

// Dilute disks under gravity: the mean height is that of exp(-m g y / kT) between floor and ceiling.
TEST(ExactBarometer, MeanHeight) {
  const double g = 1.0;
  const Scene scene =
      make_scene({8, 8, "wall", "gravity = 1.0",
                  "[[disks]]\ncount = 200\npositions = \"random\"\nvelocities = { maxwell = 1.5 }\nradius = "
                  "0.04\nmass = 1.0\n",
                  420.0, ""});
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  run_until(*engine, 20.0);
  double height = 0.0;
  double kt = 0.0;
  int samples = 0;
  while (engine->state().time < scene.run.t_end) {
    run_until(*engine, std::min(engine->state().time + 0.5, scene.run.t_end));
    const Disks& d = engine->state().disks;
    for (std::size_t i = 0; i < d.size(); ++i) height += (d.y[i] - 0.04) / 200.0;
    kt += energy_of(d, 0.0).kinetic / 200.0;
    ++samples;
  }
  height /= samples;
  kt /= samples;
  const double span = 8.0 - 0.08;
  const double scale = kt / g;
  EXPECT_NEAR(height, scale - span / (std::exp(span / scale) - 1.0), 0.03 * scale);
}

// The share of Brownian points that an absorbing square has not taken yet.
TEST(ExactAbsorption, SurvivorsOfASquare) {
  const Scene scene =
      make_scene({1, 1, "sink", "diffusion = 1.0",
                  "[[disks]]\ncount = 3000\npositions = \"random\"\nradius = 1e-7\nmass = 1.0\n", 0.1, "dt = 2e-4"});
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  const double tau[] = {0.01, 0.02, 0.05, 0.1};
  const double share[] = {0.599578, 0.463552, 0.245929, 0.0912753};
  for (int k = 0; k < 4; ++k) {
    run_until(*engine, tau[k] * (1.0 - 1e-9));
    const double left = static_cast<double>(engine->state().disks.size()) / 3000.0;
    EXPECT_NEAR(left, share[k], 3.5 * std::sqrt(share[k] * (1.0 - share[k]) / 3000.0)) << "tau " << tau[k];
  }
}

TEST(ExactLongRun, NoOverlapNoDrift) {
  const Scene scene = gas(2000, 0.6, 60.0);
  const State initial = initial_state(scene);
  const auto engine = make_parallel_engine(scene, initial, {2, 1});
  const double energy = energy_of(initial.disks, 0.0).kinetic;
  const Momentum start = momentum_of(initial.disks);
  double overlap = 0.0;
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    overlap = std::max(overlap, max_overlap(engine->state().disks, scene.box));
  }
  EXPECT_GT(engine->state().counters.collisions, 500000U);
  EXPECT_LT(overlap, 1e-13);
  EXPECT_NEAR(energy_of(engine->state().disks, 0.0).kinetic / energy, 1.0, 1e-11);
  const Momentum p = momentum_of(engine->state().disks);
  EXPECT_LT(std::hypot(p.x - start.x, p.y - start.y) / start.magnitude, 1e-12);
}

}  // namespace
}  // namespace carom::exact_tests
