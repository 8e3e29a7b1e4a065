// Steps that are far too long: errors are the same in both engines, and are reported.
#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/scene_support.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom {
namespace {

TEST(Wrap, BringsACoordinateBackFromAnyDistance) {
  for (const double period : {1.0, 6.4, 0x1p-20, 3e5}) {
    for (const double share : {0.0, 0.3, 0.999}) {
      for (const int periods : {-1000, -3, -2, -1, 0, 1, 2, 3, 1000}) {
        const double c = (share + periods) * period;
        const double wrapped = wrap(c, period);
        EXPECT_GE(wrapped, 0.0);
        EXPECT_LT(wrapped, period);
        const double off = std::abs(wrapped - share * period);
        EXPECT_LT(std::min(off, period - off), 1e-12 * period) << c << " in " << period;
      }
    }
  }
  EXPECT_EQ(wrap(-1e-300, 1.0), 0.0);
  EXPECT_EQ(wrap(1.0, 1.0), 0.0);
}

// A thermal side sends disks of mass 1e-6 through many widths of the box within the step in which they meet it. The
// next step is refused; until then both engines have the same disks, all inside the box.
TEST(FarStep, DisksThatGoThroughManyPeriodsAreInTheBox) {
  const Scene scene = test::scene_from(R"(seed = 520453
[box]
width = 6.4
height = 9.1
left = "periodic"
right = "periodic"
bottom = "wall"
top = { kind = "wall", temperature = 2.593 }
[[disks]]
count = 2
positions = "random"
velocities = { maxwell = 0.5 }
radius = 0.85
mass = { uniform = [0.45, 1.35] }
[[disks]]
count = 140
positions = "random"
velocities = { uniform = 1.76 }
radius = { from_mass = 4e-5 }
mass = { uniform = [4e-7, 1.2e-6] }
[run]
method = "pairwise"
dt = 0.577
t_end = 20.0
)");
  const State start = initial_state(scene);
  const auto reference = make_reference_engine(scene, start);
  reference->step();
  for (const int threads : test::thread_counts) {
    const auto engine = make_parallel_engine(scene, start, {threads, 128});
    engine->step();
    EXPECT_EQ(state_hash(engine->state().disks), state_hash(reference->state().disks)) << threads;
    EXPECT_THROW(engine->step(), PhysicsError);
  }
  for (const double x : reference->state().disks.x) {
    EXPECT_GE(x, 0.0);
    EXPECT_LT(x, scene.box.width);
  }
  EXPECT_THROW(reference->step(), PhysicsError);
}

}  // namespace
}  // namespace carom
