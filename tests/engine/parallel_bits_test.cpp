// The engine compared with the reference: the same bits after every step, for random scenes with all combinations of
// features, on 1, 2, 3, 5 and 8 threads. The work is cut into many small blocks, so that it is divided even in small
// scenes.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"
#include "tests/support/disks_by_hand.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/same_counters.hpp"
#include "tests/support/thread_counts.hpp"

namespace carom {
namespace {

using test::Features;

constexpr int steps = 12;

struct Trace {
  std::vector<std::uint64_t> hashes;
  Counters counters;
  SinkCounts taken;
  std::vector<std::string> warnings;
  std::string error;  // in exact: inelastic collapse
};

Trace trace_of(Engine& engine, double t_end) {
  Trace trace;
  try {
    for (int k = 0; k < steps && engine.state().time < t_end; ++k) {
      engine.step();
      trace.hashes.push_back(state_hash(engine.state().disks));
    }
  } catch (const PhysicsError& error) {
    trace.error = error.what();
  }
  trace.counters = engine.state().counters;
  trace.taken = engine.state().taken;
  trace.warnings = engine.take_warnings();
  return trace;
}

void expect_same(const Trace& a, const Trace& b) {
  ASSERT_EQ(a.hashes, b.hashes);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.error, b.error);
  test::expect_same_counters(a.counters, b.counters);
  EXPECT_EQ(a.taken, b.taken);
}

class ParallelBits : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(ParallelBits, EqualTheReferenceAfterEveryStep) {
  Count collisions = 0;
  Count emitted = 0;
  Count removed = 0;
  const std::vector<Features> scenes = test::all_features(std::get<0>(GetParam()), std::get<1>(GetParam()));
  for (const Features& f : scenes) {
    SCOPED_TRACE(f.name());
    const Scene scene = test::feature_scene(f, steps);
    const State start = initial_state(scene);
    const Trace expected = trace_of(*make_reference_engine(scene, start), scene.run.t_end);
    for (const int threads : test::thread_counts) {
      SCOPED_TRACE(threads);
      expect_same(expected, trace_of(*make_parallel_engine(scene, start, {threads, 512}), scene.run.t_end));
      if (::testing::Test::HasFatalFailure()) return;
    }
    collisions += expected.counters.collisions;
    emitted += expected.counters.emitted;
    removed += expected.counters.removed;
    EXPECT_EQ(test::all_taken(expected.taken), expected.counters.removed);
  }
  // Without collisions in the scenes the comparison would show nothing.
  EXPECT_GT(collisions, 35U * scenes.size());
  EXPECT_GT(emitted, scenes.size() * 7 / 20);
  if (std::string(std::get<1>(GetParam())) == "sink") {
    EXPECT_GT(removed, 100U);
  }
}

constexpr std::array methods{"pairwise", "rollback", "exact"};
// TiltedBits tests the same methods and is fast.
INSTANTIATE_TEST_SUITE_P(LongAllScenes, ParallelBits,
                         ::testing::Combine(::testing::ValuesIn(methods),
                                            ::testing::Values("wall", "periodic", "periodic_x", "sink", "soft", "hot",
                                                              "moving")),
                         test::method_and_sides);

class TiltedBits : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

// Gravity as a vector, with and without obstacles, and with the other features in turn.
TEST_P(TiltedBits, EqualTheReferenceAfterEveryStep) {
  Count collisions = 0;
  std::size_t scenes = 0;
  for (Features f : test::all_features(std::get<0>(GetParam()), std::get<1>(GetParam()))) {
    if (!f.gravity || f.seed % 5 != 0) continue;
    f.tilted = true;
    f.obstacles = ++scenes % 2 == 0 && f.radii != "wide";
    SCOPED_TRACE(f.name());
    const Scene scene = test::feature_scene(f, steps);
    const State start = initial_state(scene);
    const Trace expected = trace_of(*make_reference_engine(scene, start), scene.run.t_end);
    for (const int threads : {1, 3}) {
      expect_same(expected, trace_of(*make_parallel_engine(scene, start, {threads, 512}), scene.run.t_end));
      if (::testing::Test::HasFatalFailure()) return;
    }
    collisions += expected.counters.collisions;
  }
  EXPECT_GT(scenes, 1U);
  EXPECT_GT(collisions, 25U * scenes);
}

INSTANTIATE_TEST_SUITE_P(AllScenes, TiltedBits,
                         ::testing::Combine(::testing::ValuesIn(methods),
                                            ::testing::Values("wall", "periodic", "sink", "moving")),
                         test::method_and_sides);
INSTANTIATE_TEST_SUITE_P(LongAllScenes, TiltedBits,
                         ::testing::Combine(::testing::ValuesIn(methods),
                                            ::testing::Values("periodic_x", "soft", "hot")),
                         test::method_and_sides);

class ThermostatBits : public ::testing::TestWithParam<const char*> {};

// Thermostats, whose kicks come between steps, with the other features in turn.
TEST_P(ThermostatBits, EqualTheReferenceAfterEveryStep) {
  for (const char* sides : {"wall", "periodic", "sink", "hot", "moving"}) {
    std::size_t scenes = 0;
    for (Features f : test::all_features(GetParam(), sides)) {
      if (!f.diffusion.empty() || f.seed % 4 != 0) continue;
      f.thermostat = ++scenes % 2 == 0 ? "langevin" : "andersen";
      SCOPED_TRACE(f.name());
      const Scene scene = test::feature_scene(f, steps);
      const State start = initial_state(scene);
      const Trace expected = trace_of(*make_reference_engine(scene, start), scene.run.t_end);
      EXPECT_NE(expected.counters.thermostat_heat, 0.0);
      for (const int threads : {1, 3}) {
        expect_same(expected, trace_of(*make_parallel_engine(scene, start, {threads, 512}), scene.run.t_end));
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
    EXPECT_GT(scenes, 2U);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, ThermostatBits, ::testing::Values("pairwise"));
INSTANTIATE_TEST_SUITE_P(LongMethods, ThermostatBits, ::testing::Values("rollback", "exact"));

// Blocks of any size give the same state: nothing depends on where one block ends and the next one begins.
TEST(ParallelBlocks, OfAnySizeGiveTheSameBits) {
  Features f;
  f.gravity = true;
  f.restitution = 0.7;
  f.radii = "mixed";
  f.own_masses = true;
  const Scene scene = test::feature_scene(f, steps);
  const State start = initial_state(scene);
  const Trace expected = trace_of(*make_reference_engine(scene, start), scene.run.t_end);
  for (const std::size_t divisor : {1U, 7U, 64U, 1000U, 100000U}) {
    SCOPED_TRACE(divisor);
    expect_same(expected, trace_of(*make_parallel_engine(scene, start, {3, divisor}), scene.run.t_end));
  }
}

// Without a divisor 20,000 disks make four blocks of 5000, which are distributed to threads in the same way in all
// phases (Executor).
TEST(ParallelBlocks, AFewLargeOnesGiveTheBitsOfTheReference) {
  const Scene scene = parse_scene(R"(
    [box]
    width = 200.0
    height = 120.0
    left = "periodic"
    right = "periodic"
    [physics]
    gravity = 1.0
    restitution = 0.8
    [[disks]]
    count = 20000
    positions = "square"
    velocities = { maxwell = 1.0 }
    radius = { uniform = [0.3, 0.5] }
    mass = 1.0
    [run]
    method = "pairwise"
    dt = 0.02
    t_end = 0.24
  )",
                                  "large", "");
  const State start = initial_state(scene);
  const Trace expected = trace_of(*make_reference_engine(scene, start), scene.run.t_end);
  EXPECT_GT(expected.counters.collisions, 1000U);
  for (const int threads : test::thread_counts) {
    SCOPED_TRACE(threads);
    expect_same(expected, trace_of(*make_parallel_engine(scene, start, {threads}), scene.run.t_end));
  }
}

// A disk that others have pushed into a side, and that now touches nothing else and does not approach the side.
TEST(ParallelBlocks, ADiskWithinASideIsPushedOut) {
  for (const Method method : {Method::pairwise, Method::rollback}) {
    const Scene scene = test::scene_of(method, 20.0, 20.0, 0.01, 1.0);
    const State start = test::state_of(scene, {{0.48, 10.0, 0.1, 0.0, 0.5, 1.0}, {9.0, 9.0, 0.3, 0.1, 0.5, 1.0}});
    const auto reference = make_reference_engine(scene, start);
    const auto parallel = make_parallel_engine(scene, start, {1});
    reference->step();
    parallel->step();
    EXPECT_EQ(state_hash(parallel->state().disks), state_hash(reference->state().disks));
  }
}

}  // namespace
}  // namespace carom
