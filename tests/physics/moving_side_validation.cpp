// Moving sides compared with theory: a gas compressed along its adiabat, and a ball that bounces in step with its
// floor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/load/scene_file.hpp"
#include "core/load/scene_scales.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/engine_run.hpp"

namespace carom {
namespace {

using test::run_by_engine;

double total_energy(const Scene& scene, const State& state) {
  return energy_of(state.disks, scene.physics.gravity).total();
}

// d ln T = -Z d ln V. The centres of disks have the box's width less a diameter; for the packing fraction half of that
// is taken off.
TEST(MovingSide, CompressesAGasAlongItsAdiabat) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/piston.toml",
                                 {{"box.right.motion.velocity", "[-0.1, 0]"}, {"run.t_end", "392.7"}});
  const State start = initial_state(scene);
  const State end = run_by_engine(scene, start);
  const double radius = start.disks.common_radius;
  const double area = static_cast<double>(start.disks.size()) * std::acos(-1.0) * radius * radius;
  const auto width = [&](double t) { return scene.box.width - scene.box.motions[1].at(t).inset - radius; };
  constexpr int parts = 1000;
  double log_ratio = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double from = width(scene.run.t_end * k / parts);
    const double to = width(scene.run.t_end * (k + 1) / parts);
    log_ratio += compressibility(area / (0.5 * (from + to) * scene.box.height)) * std::log(from / to);
  }
  const double before = total_energy(scene, start);
  const double after = total_energy(scene, end);
  EXPECT_NEAR(std::log(after / before), log_ratio, 0.02 * log_ratio);
  EXPECT_GT(log_ratio, 1.2 * std::log(2.0));  // an ideal gas would double its temperature
  EXPECT_NEAR(before + end.counters.side_energy[1], after, 1e-12 * after);
}

// A ball with restitution e bounces once in each period T if the floor moves up at g T (1 - e) / (2 (1 + e)) when it
// lands. That orbit is stable if the floor's deceleration is below 2 g (1 + e^2) / (1 + e)^2.
TEST(MovingSide, MakesABallBounceInStep) {
  for (const std::string method : {"exact", "pairwise"}) {
    SCOPED_TRACE(method);
    const Scene scene = parse_scene(
        "[box]\nwidth = 4.0\nheight = 10.0\nbottom = { restitution = 0.8, motion = { vibrate = [0, 0.01], period = 1 } "
        "}\n"
        "[physics]\ngravity = 1.0\n[[disks]]\ncount = 1\npositions = [[2, 0.5505]]\nvelocities = [[0, -0.4236]]\n"
        "radius = 0.5\nmass = 2.0\n[run]\nmethod = \"" +
            method + "\"\ndt = 0.0005\nt_end = 400.0\n",
        "ball", "");
    Count halfway = 0;
    double work = 0.0;
    const State end = run_by_engine(scene, initial_state(scene), [&](const State& s) {
      if (s.time > 200.0) return;
      halfway = s.counters.wall_collisions;
      work = s.counters.side_energy[2];
    });
    EXPECT_NEAR(static_cast<double>(end.counters.wall_collisions - halfway), 200.0, 1.0);
    // It lands at w = g T / (1 + e) in the floor's frame and loses m w^2 (1 - e^2) / 2 in each period, which is the
    // floor's work.
    const double u = 0.5 * 0.2 / 1.8;
    const double impulse = 2.0 * 1.0;  // m g T in each period, to come up again
    EXPECT_NEAR((end.counters.side_energy[2] - work) / (200.0 * impulse * u), 1.0, 0.01);
  }
}

// Two disks one above the other, and a ceiling that comes down to less than two diameters above the floor: collisions
// that the TC model makes elastic become as frequent as those of elastic disks, and time stops advancing.
TEST(MovingSide, StopsWhereItWouldCrushDisksThatStayInContact) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 2.1\nheight = 6.0\ntop = { motion = { velocity = [0, -0.5] } }\n[physics]\nrestitution = 0.5\n"
      "collapse = { model = \"tc\", contact_time = 1e-3 }\n[[disks]]\ncount = 2\npositions = [[1.05, 1.5], [1.05, "
      "4.0]]\n"
      "velocities = [[0.1, 0], [0, -0.1]]\nradius = 1.0\nmass = 1.0\n[run]\nmethod = \"exact\"\nt_end = 6.0\n",
      "jam", "");
  try {
    run_by_engine(scene, initial_state(scene));
    ADD_FAILURE() << "no error, though there is no room for both disks";
  } catch (const PhysicsError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the top side is at y = "));
  }
}

}  // namespace
}  // namespace carom
