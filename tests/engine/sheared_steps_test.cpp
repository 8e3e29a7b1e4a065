// Steps in a sheared box are split according to the fastest disks, including those that have just come through its top
// or bottom.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// A disk at the top moves against the flow at 5; when it comes in at the bottom the jump of 10 has made that 15, with
// which it moves further in a step than half of its radius.
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

// The shear heats these disks so much within one step of 158 parts that some move further than the height of the box in
// a part. They must be put back into it, so that the search finds them.
TEST(ShearedSteps, BringDisksBackThatGoFurtherThanTheBox) {
  const Scene scene = parse_scene(
      "seed = 895681\n[box]\nwidth = 25.985648614130938\nheight = 3.846\nleft = \"periodic\"\nright = \"periodic\"\n"
      "bottom = \"periodic\"\ntop = \"periodic\"\nshear_rate = 0.01458\n[[disks]]\ncount = 27\npositions = \"random\"\n"
      "velocities = { maxwell = 5e-07 }\nradius = 0.4805\nmass = { uniform = [0.5, 1] }\n"
      "[run]\nmethod = \"pairwise\"\ndt = 1442\nt_end = 5768\n",
      "scene", "");
  const auto plain = make_reference_engine(scene, initial_state(scene));
  const auto parallel = make_parallel_engine(scene, initial_state(scene), {2});
  plain->step();
  parallel->step();
  const Disks& d = plain->state().disks;
  double fastest = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    EXPECT_TRUE(d.y[i] >= 0.0 && d.y[i] < scene.box.height) << "disk " << i << " at y = " << d.y[i];
    fastest = std::max(fastest, std::abs(d.vy[i]));
  }
  EXPECT_GT(fastest * scene.run.dt / plain->state().validity.parts.figure, scene.box.height);
  EXPECT_EQ(state_hash(parallel->state().disks), state_hash(d));
}

}  // namespace
}  // namespace carom
