// Steps in a sheared box are split as fast disks need it, those that have just come through its top or bottom, too.
#include <gtest/gtest.h>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// Against the flow at the top a disk has a speed of 5; at the bottom, where it comes in, the jump of 10 has made that
// 15, with which it goes further in a step than half of its radius.
TEST(ShearedSteps, AreSplitWhereADiskHasJumpedToAHighSpeed) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 10.0\nheight = 10.0\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\n"
      "top = \"periodic\"\nshear_rate = 1.0\n[[disks]]\ncount = 1\npositions = [[5.0, 9.9]]\n"
      "velocities = [[-9.9, 2.0]]\nradius = 0.5\nmass = 1.0\n[run]\nmethod = \"pairwise\"\ndt = 0.03\nt_end = 0.3\n",
      "scene", "");
  const auto plain = make_reference_engine(scene, initial_state(scene));
  const auto parallel = make_parallel_engine(scene, initial_state(scene), {1});
  for (int k = 0; k < 10; ++k) {
    plain->step();
    parallel->step();
    EXPECT_EQ(state_hash(parallel->state().disks), state_hash(plain->state().disks)) << k;
    EXPECT_EQ(parallel->state().validity.parts.figure, plain->state().validity.parts.figure) << k;
  }
  EXPECT_EQ(plain->state().validity.parts.figure, 2.0);
}

}  // namespace
}  // namespace carom
