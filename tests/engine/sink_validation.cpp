// Brownian motion in absorbing boxes compared with theory, and the whole run of brownian_sink.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

// Disks start uniformly in an absorbing square of side L (the box's side minus a diameter). The share left at tau = D t
// / L^2 is compared with docs/reference_values.md, with a tolerance of 3 standard errors. The disks are so small that
// they hardly ever meet. The step is so long (tau 0.0025) that without the crossing probability of sinks the share
// would be far too high.
TEST(Sink, AbsorbingSquareLeavesWhatTheorySays) {
  const double tau[] = {0.01, 0.02, 0.05, 0.1, 0.2};
  const double survival[] = {0.599578, 0.463552, 0.245929, 0.0912753, 0.0126781};
  constexpr int runs = 500;
  constexpr int n = 20;
  for (Method method : test::stepping_methods) {
    double left[5] = {};
    for (int run = 0; run < runs; ++run) {
      Scene scene = test::scene_of(method, 1.002, 1.002, 0.0025, 0.2);
      test::set_sides(scene.box, SideKind::sink, SideKind::sink);
      scene.physics.diffusion = 1.0;
      scene.seed = static_cast<std::uint64_t>(1000 + run);
      DiskGroup group;
      group.count = n;
      group.radius.value = 0.001;
      group.mass.value = 1.0;
      scene.groups.push_back(group);
      int next = 0;
      test::run(scene, initial_state(scene), [&](const Engine& engine) {
        while (next < 5 && engine.state().time >= tau[next] * (1.0 - 1e-9)) {
          left[next++] += static_cast<double>(engine.state().disks.size()) / (runs * n);
        }
      });
      ASSERT_EQ(next, 5);
    }
    for (int k = 0; k < 5; ++k) {
      const double error = std::sqrt(survival[k] * (1.0 - survival[k]) / (runs * n));
      std::printf("%s: S(%g) = %.4f, theory %.4f, standard error %.4f\n", test::name_of(method).c_str(), tau[k],
                  left[k], survival[k], error);
      EXPECT_NEAR(left[k], survival[k], 3.0 * error);
    }
  }
}

// The whole run: the number of disks only falls, and at the end hardly any is left (the slowest mode has decayed by
// exp(-2)).
TEST(Sink, BrownianSinkSceneOnlyTakes) {
  const Scene scene = load_scene(CAROM_SOURCE_DIR "/scenes/brownian_sink.toml");
  const State start = initial_state(scene);
  std::size_t count = start.disks.size();
  bool fell = true;
  const State end = test::run(scene, start, [&](const Engine& engine) {
    fell = fell && engine.state().disks.size() <= count;
    count = engine.state().disks.size();
  });
  EXPECT_TRUE(fell);
  EXPECT_EQ(end.counters.removed, start.disks.size() - count);
  EXPECT_LT(count, start.disks.size() / 4);
  std::printf("brownian_sink: %zu disks at the start, %zu at the end\n", start.disks.size(), count);
}

}  // namespace
}  // namespace carom
