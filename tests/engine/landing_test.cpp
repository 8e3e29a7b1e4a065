// Disks that land at the longest safe step overlap by no more than the limit below which resolving is not repeated
// (core/step/step_rounds.hpp); this includes disks that a wall throws back onto others in the same step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/step_rounds.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/silo.hpp"

namespace carom {
namespace {

// Silos of 200 disks, poured with these seeds. In some of them an impact sends a disk back into the wall, to the very
// place where its drift ended; such disks once lay up to 4 % of their radius beyond the wall at the end of a step.
TEST(LongLanding, LeavesNoDiskPressedIntoAWallOrAnother) {
  test::Silo silo{200, 2.0, 0.4, 0.6, 0.01};
  const double fall = std::sqrt(2.0 * test::silo_scene(silo).box.height);
  silo.dt = 0.45 * silo.smallest / fall;
  Scene scene = test::silo_scene(silo);
  for (scene.seed = 100; scene.seed < 120; ++scene.seed) {
    SCOPED_TRACE(scene.seed);
    const auto engine = make_parallel_engine(scene, initial_state(scene), {1, 1});
    double pair = 0.0;
    double wall = 0.0;
    while (engine->state().time < 0.8 * fall) {
      engine->step();
      pair = std::max(pair, max_overlap(engine->state().disks, scene.box));
      wall = std::max(wall, wall_overlap(engine->state().disks, scene.box));
    }
    EXPECT_LE(pair, 1.2 * pressed_overlap);
    EXPECT_LE(wall, 1.2 * pressed_overlap);
  }
}

}  // namespace
}  // namespace carom
