// Grown states are states of the fluid: their pressure is that of disks placed in other ways.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/sample_mean.hpp"
#include "core/measure/invariants.hpp"
#include "parallel/simulation.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/scene_support.hpp"

namespace carom {
namespace {

using test::scene_from;

constexpr int disks = 500;

Scene fluid(std::string_view positions, std::string_view radius, double packing, double t_end) {
  return scene_from(
      fmt::format("seed = 3\n[box]\npacking_fraction = {}\nleft = \"periodic\"\nright = \"periodic\"\nbottom = "
                  "\"periodic\"\ntop = \"periodic\"\n[[disks]]\ncount = {}\npositions = \"{}\"\nradius = {}\nmass = "
                  "1\nvelocities = {{ maxwell = 1.0 }}\n[run]\nt_end = {}\n",
                  packing, disks, positions, radius, t_end));
}

// Z = P V / (N kT) from the virial, in blocks, after a first one to forget the start.
SampleMean compressibility(std::string_view positions, std::string_view radius, double packing, double block) {
  constexpr int blocks = 24;
  const Scene scene = fluid(positions, radius, packing, 1e9);
  const auto engine = make_parallel_engine(scene, parallel_initial_state(scene, 2), {2, 1});
  engine->forget_paths();
  const double kt = energy_of(engine->state().disks, 0.0).kinetic / (disks - 1.0);
  std::vector<double> found;
  for (int k = -4; k < blocks; ++k) {
    const double start = engine->state().time;
    const double before = engine->state().counters.virial;
    while (engine->state().time < start + block) engine->step();
    const double z =
        1.0 + (engine->state().counters.virial - before) / (2.0 * (engine->state().time - start) * disks * kt);
    if (k >= 0) found.push_back(z);
  }
  EXPECT_GT(engine->state().counters.collisions, 20.0 * disks * blocks) << "the run is too short for a comparison";
  EXPECT_LE(max_overlap(engine->state().disks, scene.box), 1e-13);
  return sample_mean(found);
}

void expect_same(const SampleMean& grown, const SampleMean& other, const char* what) {
  fmt::print("{}: Z grown {:.4f} +- {:.4f}, other start {:.4f} +- {:.4f}\n", what, grown.mean, grown.standard_error(),
             other.mean, other.standard_error());
  EXPECT_NEAR(grown.mean, other.mean, 3.0 * std::hypot(grown.standard_error(), other.standard_error())) << what;
  EXPECT_LT(grown.standard_error(), 0.01 * grown.mean) << "the run is too short for a comparison";
}

TEST(GrownFluid, HasThePressureOfAMeltedLattice) {
  std::string radii = "[";
  for (int k = 0; k < disks; ++k) radii += k % 2 == 0 ? "1, " : "1.4, ";
  radii += "]";
  expect_same(compressibility("growth", radii, 0.6, 20.0), compressibility("hexagonal", radii, 0.6, 20.0),
              "bidisperse, packing fraction 0.6");
}

TEST(GrownFluid, HasThePressureOfDisksPlacedAtRandom) {
  constexpr const char* radii = "{ uniform = [1, 5] }";
  expect_same(compressibility("growth", radii, 0.55, 60.0), compressibility("random", radii, 0.55, 60.0),
              "radii from 1 to 5, packing fraction 0.55");
}

}  // namespace
}  // namespace carom
