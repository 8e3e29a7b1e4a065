// scenes/mixing.toml and scenes/tracer_in_bath.toml, compared with the statements in their comments.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/load/scene_file.hpp"
#include "core/scene/disk_group.hpp"
#include "parallel/simulation.hpp"
#include "parallel/start/random_placement.hpp"
#include "tests/support/motion_of_group.hpp"

namespace carom {
namespace {

const std::string folder = CAROM_SOURCE_DIR "/scenes/";

State run_scene(const Scene& scene) {
  const auto engine = make_parallel_engine(scene, parallel_initial_state(scene, 2), {2});
  while (engine->state().time < scene.run.t_end) engine->step();
  return engine->state();
}

GroupMotion motion_of(const Scene& scene, const Disks& disks, const std::string& name) {
  std::vector<std::size_t> members;
  for (const NamedGroup& group : named_groups(scene)) {
    if (group.name != name) continue;
    for (const std::size_t i : by_id(disks)) {
      if (group.ids.holds(disks.id[i])) members.push_back(i);
    }
  }
  EXPECT_FALSE(members.empty());
  return test::group_motion(disks, members);
}

// Energy is conserved, so the mean of both temperatures stays 2.5; that of each group, of 400 disks, fluctuates by at
// most T / sqrt(400).
TEST(GroupScenes, MixingComesToOneTemperature) {
  Scene scene = load_scene(folder + "mixing.toml", {{"run.t_end", "100.0"}});
  const State start = parallel_initial_state(scene, 1);
  EXPECT_NEAR(motion_of(scene, start.disks, "hot").temperature, 4.0, 1e-12);
  for (std::size_t i = 0; i < 800; ++i) {
    EXPECT_TRUE(start.disks.id[i] < 400 ? start.disks.x[i] <= 23.5 : start.disks.x[i] >= 24.5) << i;
  }
  double hot = 0.0, cold = 0.0;
  for (int seed = 1; seed <= 4; ++seed) {
    scene.seed = static_cast<std::uint64_t>(seed);
    const State end = run_scene(scene);
    hot += motion_of(scene, end.disks, "hot").temperature / 4.0;
    cold += motion_of(scene, end.disks, "cold").temperature / 4.0;
  }
  EXPECT_NEAR(hot, 2.5, 4.0 * 2.5 / 20.0 / 2.0);
  EXPECT_NEAR(hot + cold, 5.0, 0.05) << "the rest is the motion of the gas as a whole";
}

// The hot gas expands and cools until both have the same temperature, and is compressed again half an oscillation
// later.
TEST(GroupScenes, MixingSwingsFirst) {
  const auto hot_at = [](const char* time) {
    Scene scene = load_scene(folder + "mixing.toml", {{"run.t_end", time}});
    double hot = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      scene.seed = seed;
      hot += motion_of(scene, run_scene(scene).disks, "hot").temperature / 4.0;
    }
    return hot;
  };
  EXPECT_NEAR(hot_at("8.0"), 2.5, 0.2);
  EXPECT_NEAR(hot_at("20.0"), 3.25, 0.25);
}

// The friction of a tracer of mass M in two dimensions in Enskog's first approximation: gamma = 2 n g sigma sqrt(2 pi
// mu T) / M; for the relative velocity times 1 + M N_tracer / (m N_bath). It is measured within about one collision of
// each tracer, before the flow that the tracers cause in the bath acts back on them.
TEST(LongGroupScenes, ABathBrakesTracersAsEnskogSays) {
  Scene scene = load_scene(folder + "tracer_in_bath.toml", {{"run.t_end", "0.3"}, {"analysis.start", "0.0"}});
  constexpr double eta = 0.3;
  const double n = 4.0 * eta / std::numbers::pi;
  const double g = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
  const double gamma = 2.0 * n * g * std::sqrt(2.0 * std::numbers::pi * (10.0 / 11.0)) / 10.0;
  constexpr int runs = 120;
  double mean = 0.0;
  for (int seed = 1; seed <= runs; ++seed) {
    scene.seed = static_cast<std::uint64_t>(seed);
    const State end = run_scene(scene);
    mean += (motion_of(scene, end.disks, "tracer").velocity.x - motion_of(scene, end.disks, "bath").velocity.x) / runs;
  }
  // The mean over all runs has an error of 0.4 % of the velocity, and the rate one of 4 %.
  const double rate = -std::log(mean / 0.5) / 0.3;
  EXPECT_NEAR(rate, 1.1 * gamma, 0.15 * gamma);
}

}  // namespace
}  // namespace carom
