// The viscosity of hard disks in a shear flow compared with Enskog's theory, and the steady flow of
// scenes/couette.toml.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/measure/shear_flow.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"

namespace carom {
namespace {

// For disks of diameter 1 and mass 1 at temperature 1 (Gass 1971; Garcia-Rojo, Luding and Brey 2006): the viscosity of
// the dilute gas, 1.022 / (2 sqrt(pi)), times 1 / chi + 2 nu + (1 + 8 / pi) chi nu^2.
double enskog_viscosity(double packing) {
  const double chi = (1.0 - 7.0 * packing / 16.0) / ((1.0 - packing) * (1.0 - packing));
  const double dilute = 1.022 / (2.0 * std::sqrt(std::numbers::pi));
  return dilute * (1.0 / chi + 2.0 * packing + (1.0 + 8.0 / std::numbers::pi) * chi * packing * packing);
}

struct Measured {
  double viscosity = 0.0;    // over the square root of the temperature, to which it is proportional
  double temperature = 0.0;  // mean
  double last = 0.0;         // temperature at the end
};

// Means over samples about `every` apart, from time `from` on.
Measured measure(const Scene& scene, double from, double every) {
  const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
  while (engine->state().time < from) engine->step();
  Measured mean;
  double before = engine->state().counters.shear_virial, begin = engine->state().time;
  int samples = 0;
  while (engine->state().time < scene.run.t_end) {
    while (engine->state().time < std::min(scene.run.t_end, begin + every)) engine->step();
    const State& now = engine->state();
    const Disks relative = relative_to_flow(now.disks, scene.box);
    mean.last = energy_of(relative, 0.0).kinetic / static_cast<double>(relative.size());
    double flow = 0.0;
    for (std::size_t i = 0; i < relative.size(); ++i) flow += relative.mass_of(i) * relative.vx[i] * relative.vy[i];
    const double stress = shear_stress(flow, now.counters.shear_virial - before, now.time - begin, scene.box);
    mean.viscosity += stress / scene.box.shear.rate / std::sqrt(mean.last);
    mean.temperature += mean.last;
    before = now.counters.shear_virial;
    begin = now.time;
    ++samples;
  }
  mean.viscosity /= samples;
  mean.temperature /= samples;
  return mean;
}

// Elastic disks heat up, so the shear becomes slower compared with their own motion. The mean over such a run has an
// error of about 2 %.
TEST(ShearFlow, HasTheViscosityOfEnskog) {
  for (const char* method : {"exact", "pairwise"}) {
    for (const double packing : {0.1, 0.2, 0.3}) {
      const Scene scene = parse_scene(
          fmt::format("[box]\npacking_fraction = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
                      "top = \"periodic\"\nshear_rate = 0.1\n[[disks]]\ncount = 2000\npositions = \"random\"\n"
                      "velocities = {{ maxwell = 1.0 }}\nradius = 0.5\nmass = 1.0\n"
                      "[run]\nmethod = \"{}\"\ndt = 0.01\nt_end = 150.0\n",
                      packing, method),
          "shear.toml", "");
      const Measured m = measure(scene, 5.0, 0.25);
      EXPECT_NEAR(m.viscosity / enskog_viscosity(packing), 1.0, 0.06) << method << " " << packing;
      EXPECT_GT(m.last, 2.0) << "the shear must heat the disks";
    }
  }
}

// The shear gives what collisions lose: the temperature becomes steady, with the same value from any start.
TEST(ShearFlow, OfInelasticDisksIsSteady) {
  for (const char* start : {"0.3", "5.0"}) {
    const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/couette.toml",
                                   {{"disks.0.velocities", fmt::format("{{ maxwell = {} }}", start)}});
    const Measured m = measure(scene, 60.0, 0.5);
    EXPECT_NEAR(m.viscosity / enskog_viscosity(0.2), 1.0, 0.06);
    EXPECT_NEAR(m.temperature, 2.01, 0.12) << "2.01 is from a run ten times as long";
  }
}

// In a steady flow collisions transfer no mean torque if disks turn with the flow, at half the vorticity, -g / 2 (C. K.
// K. Lun, J. Fluid Mech. 233, 539, 1991). Disks without spin at first take this value.
TEST(ShearFlow, TurnsRoughDisksByHalfItsVorticity) {
  for (const char* surface : {"tangential_restitution = 0.2", "tangential_restitution = 0.5, friction = 0.3"}) {
    const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/couette.toml",
                                   {{"physics.roughness", fmt::format("{{ {} }}", surface)}, {"run.t_end", "1000.0"}});
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
    double mean = 0.0, square = 0.0;
    int samples = 0;
    for (double at = 40.0; at <= scene.run.t_end; at += 2.0) {
      while (engine->state().time < at) engine->step();
      const auto& spin = engine->state().disks.spin;
      const double now = std::accumulate(spin.begin(), spin.end(), 0.0) / static_cast<double>(spin.size());
      mean += now;
      square += now * now;
      ++samples;
    }
    mean /= samples;
    const double error = std::sqrt((square / samples - mean * mean) / samples);
    const double expected = -0.5 * scene.box.shear.rate;
    EXPECT_NEAR(mean / expected, 1.0, 0.05) << surface << ": " << error / std::abs(expected);
    EXPECT_LT(error, 0.015 * std::abs(expected)) << "the statistical error is too large";
  }
}

}  // namespace
}  // namespace carom
