// Sinks have one rule in all methods: a disk that touches one is taken, whether it moves into it, along it or not at
// all.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/check.hpp"
#include "core/base/random.hpp"
#include "core/disks/disk_view.hpp"
#include "core/load/scene_file.hpp"
#include "core/physics/boundary.hpp"
#include "core/step/source.hpp"
#include "core/step/step_start.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/reference_run.hpp"

namespace carom {
namespace {

class SinkContact : public testing::TestWithParam<Method> {
 protected:
  static void expect_removed(const Scene& scene, const State& start, Count removed) {
    for (const bool parallel : {false, true}) {
      const auto engine = parallel ? make_parallel_engine(scene, start, {1}) : make_reference_engine(scene, start);
      engine->step();
      EXPECT_EQ(engine->state().counters.removed, removed) << (parallel ? "parallel" : "reference");
      EXPECT_EQ(engine->state().disks.size(), start.disks.size() - removed);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, SinkContact, testing::Values(Method::rollback, Method::pairwise, Method::exact),
                         [](const auto& method) { return test::name_of(method.param); });

TEST_P(SinkContact, WhatTouchesAtTheStartIsTaken) {
  for (const Side side : all_sides) {
    Scene scene = test::scene_of(GetParam(), 20.0, 20.0, 0.01, 2.0);
    scene.box.sides[static_cast<std::size_t>(side)] = SideKind::sink;
    const bool across_x = side == Side::left || side == Side::right;
    const double inward = side == Side::left || side == Side::bottom ? 1.0 : -1.0;
    // A disk at rest, and disks that move along the side, away from it, and into it.
    for (const Vec2 v : {Vec2{0.0, 0.0}, Vec2{0.0, 1.0}, Vec2{inward, 0.5}, Vec2{-inward, 0.0}}) {
      Disk disk{10.0, 10.0, across_x ? v.x : v.y, across_x ? v.y : v.x, 0.5, 1.0};
      (across_x ? disk.x : disk.y) = touching_coordinate(side, disk.radius, scene.box);
      expect_removed(scene, test::state_of(scene, {disk, {10.0, 10.0, 0.0, 0.0, 0.5, 1.0}}), 1);
    }
  }
}

TEST_P(SinkContact, WhatOnlyComesNearIsNot) {
  Scene scene = test::scene_of(GetParam(), 20.0, 20.0, 0.01, 2.0);
  scene.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  expect_removed(scene, test::state_of(scene, {{0.5 + 1e-12, 10.0, 0.0, 1.0, 0.5, 1.0}}), 0);
}

// A disk that rises just high enough to touch the sink, or just not.
TEST_P(SinkContact, AlongTheTopOfAParabola) {
  Scene scene = test::scene_of(GetParam(), 20.0, 20.0, 0.001, 2.0);
  scene.physics.gravity = 1.0;
  scene.box.sides[static_cast<std::size_t>(Side::top)] = SideKind::sink;
  // The disk rises by v^2 / 2 g = 0.5: to 19.51, where it would overlap the side by 0.01, or to 19.49.
  for (const bool reaches : {true, false}) {
    const State start = test::state_of(scene, {{10.0, reaches ? 19.01 : 18.99, 0.0, 1.0, 0.5, 1.0}});
    EXPECT_EQ(test::run(scene, start).counters.removed, reaches ? 1U : 0U);
  }
}

// A side that is source and sink is an open boundary. Disks start slightly inside, without touching it, so that they
// can move inwards.
TEST_P(SinkContact, ASourceOnASinkSideLetsDisksIn) {
  for (const char* side : {"left", "right", "bottom", "top"}) {
    const Scene scene = parse_scene(
        "[box]\nwidth = 20\nheight = 20\n" + std::string(side) + " = \"sink\"\n[[sources]]\nside = \"" + side +
            "\"\nrate = 5\nradius = 0.5\nmass = 1\nvelocities = { maxwell = 1.0 }\n[run]\nmethod = \"" +
            test::name_of(GetParam()) + "\"\nt_end = 4\ndt = 0.01\n",
        "test", ".");
    State start;
    start.sources.resize(1);
    const State end = test::run(scene, start);
    EXPECT_GE(end.counters.emitted, 15U);
    EXPECT_GE(end.disks.size(), 10U) << side;
    const Disk d = draw_emission(scene, scene.box, 0, 3, 3, 3);
    EXPECT_LT(reach_beyond(*scene.sources[0].side, d.x, d.y, d.radius, scene.box), 0.0);
  }
}

TEST_P(SinkContact, RegionsEmitNothingThatTouches) {
  const Scene scene = parse_scene(
      "[box]\nwidth = 20\nheight = 20\nleft = \"sink\"\n[[sources]]\nregion = [0.5, 2, 0.5, 18]\nrate = 5\n"
      "radius = 0.5\nmass = 1\n[run]\nmethod = \"" +
          test::name_of(GetParam()) + "\"\nt_end = 4\ndt = 0.01\n",
      "test", ".");
  State start;
  start.sources.resize(1);
  const State end = test::run(scene, start);
  EXPECT_EQ(end.counters.emitted, 0U);
  EXPECT_GE(end.counters.waiting, 19U);
}

TEST(SinkSource, BrownianDisksThatWouldVanishAtOnceAreRefused) {
  const std::string text =
      "[box]\nwidth = 20\nheight = 20\nleft = \"sink\"\n[physics]\ndiffusion = 1.0\n[[sources]]\nside = \"left\"\n"
      "rate = 5\nradius = 0.5\nmass = 1\n[run]\nt_end = 4\ndt = 0.01\n";
  try {
    parse_scene(text, "gas.toml", ".");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "gas.toml:8: sources.0.side: left is a sink, which would remove Brownian disks that start there at "
                 "once; expected a wall side, or a region away from the sink");
  }
}

// A Brownian disk is taken with probability exp(-d1 d2 / (D dt)), where d1 and d2 are its distances from the side
// before and after the step (see sink_crossed). The number drawn must decide so for any distances.
TEST(BrownianSink, CrossingIsThatOfABridge) {
  Scene scene = test::scene_of(Method::pairwise, 20.0, 20.0, 0.01, 2.0);
  scene.physics.diffusion = 0.5;
  scene.box.sides[static_cast<std::size_t>(Side::left)] = SideKind::sink;
  const double dt = 0.02, spread = scene.physics.diffusion * dt;
  Count taken = 0, near = 0;
  for (DiskId id = 0; id < 20000; ++id) {
    const TwoUniforms u = uniforms(1, Stream::radius, id, 0);
    // d1 d2 is up to 60 D dt, but mostly far smaller; d2 differs from d1 by at most a tenth.
    const double distance = std::sqrt(60.0 * spread) * u.a * u.a + 0.011;
    const double gained = 0.2 * (u.b - 0.5) * distance;
    const State start = test::state_of(scene, {{0.5 + distance, 10.0, gained / dt, 0.0, 0.5, 1.0, id}});
    Disks disks = start.disks;
    disks.id[0] = id;
    const bool crosses = with_view(disks, [&](const auto& d) { return sink_crossed(d, scene, 7, dt, 0) != no_sink; });
    const auto stream = static_cast<Stream>(static_cast<std::uint32_t>(Stream::sink_crossing) +
                                            (static_cast<std::uint32_t>(Side::left) << 8U));
    const double product = distance * (distance + gained);
    const double drawn = std::log(uniforms(scene.seed, stream, id, 7).a) * spread;
    if (std::abs(drawn + product) > 1e-9 * spread) {
      EXPECT_EQ(crosses, drawn < -product) << id << ' ' << distance;
    }
    taken += crosses ? 1 : 0;
    near += product < 37.0 * spread ? 1 : 0;
  }
  EXPECT_GT(taken, 2000U);
  EXPECT_GT(near, 10000U);
  EXPECT_LT(near, 20000U);
}

// sink_crossed can omit the logarithm for large distances, since that of a uniform deviate is never below -37.
TEST(BrownianSink, NoUniformIsFurtherOut) {
  EXPECT_GT(deterministic_log(0x1p-53), -37.0);
}

}  // namespace
}  // namespace carom
