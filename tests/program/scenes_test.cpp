// The scenes that come with Carom: each can be loaded, production A conserves energy, the sink only takes disks, and
// the same scene gives the same bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/measure/invariants.hpp"
#include "core/start/initial_state.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

std::vector<std::string> files() {
  std::vector<std::string> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") list.push_back(entry.path().filename().string());
  }
  std::sort(list.begin(), list.end());
  return list;
}

TEST(Scenes, TheFiveOfTheOriginalAreThere) {
  EXPECT_THAT(files(), testing::IsSupersetOf({"brownian_sink.toml", "production_a.toml", "production_b.toml",
                                              "production_c.toml", "two_disks.toml"}));
}

// In each scene all disks are inside the box and do not overlap.
TEST(Scenes, EachLoadsAndStartsClean) {
  for (const std::string& file : files()) {
    const Scene scene = load_scene(folder + file);
    if (scene.groups.at(0).count > 10000) continue;  // it can be loaded; large scenes are tested in placement_test
    const State state = initial_state(scene);
    EXPECT_LE(max_overlap(state.disks, scene.box), 0.0) << file;
    EXPECT_LE(wall_overlap(state.disks, scene.box), 0.0) << file;
  }
}

// The same scene, read and run again, gives the same hash; another seed gives another one.
TEST(Scenes, SameSceneTwiceSameHash) {
  for (const std::string file : {"brownian_sink.toml", "production_a.toml", "production_b.toml", "two_disks.toml"}) {
    for (const char* method : {"pairwise", "rollback"}) {
      const auto hash = [&](const char* seed) {
        Scene scene = load_scene(folder + file, {{"run.method", method}, {"seed", seed}});
        scene.run.t_end = 100.0 * scene.run.dt;
        return state_hash(test::run(scene, initial_state(scene)).disks);
      };
      const std::uint64_t first = hash("1");
      EXPECT_EQ(first, hash("1")) << file;
      EXPECT_EQ(first != hash("2"), file != std::string("two_disks.toml")) << file;  // this scene draws nothing
    }
  }
}

// Production A is elastic, so its energy is constant to 1e-12 at every step of the whole run, with exact (the scene's
// own method) and in time stepping. Disks of exact never overlap by more than rounding.
TEST(Scenes, ProductionAConservesEnergy) {
  EXPECT_EQ(load_scene(folder + "production_a.toml").run.method, Method::exact);
  for (const char* method : {"exact", "pairwise"}) {
    SCOPED_TRACE(method);
    const Scene scene = load_scene(folder + "production_a.toml", {{"run.method", method}});
    const State start = initial_state(scene);
    EXPECT_GE(start.disks.size(), 100U);
    const double energy = energy_of(start.disks, 0.0).total();
    double worst = 0.0;
    double overlap = 0.0;
    const State end = test::run(scene, start, [&](const Engine& engine) {
      worst = std::max(worst, std::abs(energy_of(engine.state().disks, 0.0).total() / energy - 1.0));
      overlap = std::max(overlap, max_overlap(engine.state().disks, scene.box));
    });
    EXPECT_LE(worst, 1e-12);
    EXPECT_GT(end.counters.collisions, 500U);
    if (scene.run.method == Method::exact) {
      EXPECT_LT(overlap, 1e-13);
    }
    std::printf("A, %s: energy stays within %.2g, %llu collisions\n", method, worst,
                static_cast<unsigned long long>(end.counters.collisions));
  }
}

// The first 2000 steps of brownian_sink: the number of disks never rises, and missing disks were removed by the sink.
TEST(Scenes, BrownianSinkOnlyTakes) {
  const Scene scene = load_scene(folder + "brownian_sink.toml", {{"run.t_end", "2.0"}});
  const State start = initial_state(scene);
  std::size_t count = start.disks.size();
  bool fell = true;
  const State end = test::run(scene, start, [&](const Engine& engine) {
    fell = fell && engine.state().disks.size() <= count;
    count = engine.state().disks.size();
  });
  EXPECT_TRUE(fell);
  EXPECT_LT(count, start.disks.size());
  EXPECT_EQ(end.counters.removed, start.disks.size() - count);
}

}  // namespace
}  // namespace carom
