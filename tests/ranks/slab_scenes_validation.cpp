// Random scenes of all features on several ranks: the bits of one machine after every step. So a new feature that slabs
// do not know yet cannot be passed over by them.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "tests/fuzz_scenes/random_scene.hpp"
#include "tests/fuzz_scenes/wide_scene.hpp"
#include "tests/support/slab_support.hpp"

namespace carom {
namespace {

constexpr std::uint32_t shards = 4, scenes_a_shard = 500, wide_a_shard = 100;
constexpr std::uint64_t seed = 19;
constexpr int steps = 15;

struct Start {
  Scene scene;
  State state;
};

// Nothing where the scene cannot be made, or is for a method that ranks do not know.
std::optional<Start> start_of(const std::string& text) {
  try {
    Scene scene = parse_scene(text, "scene", "");
    if (scene.run.method == Method::rollback) return {};
    State state = initial_state(scene);
    return Start{std::move(scene), std::move(state)};
  } catch (const InputError&) {
    return {};
  }
}

struct Trace {
  std::vector<std::uint64_t> hashes;
  std::vector<std::string> said;  // warnings, and the error that ended it
};

template <class Hash>
Trace trace_of(Engine& engine, double t_end, Hash&& hash) {
  Trace trace;
  std::string error;
  try {
    for (int k = 0; k < steps && engine.state().time < t_end; ++k) {
      engine.step();
      trace.hashes.push_back(hash(engine.state().disks));
    }
  } catch (const PhysicsError& physics) {
    error = physics.what();
  }
  trace.said = engine.take_warnings();
  trace.said.push_back(error);
  return trace;
}

// Takes out that one rank runs all, and returns whether it was there.
bool leave_out_ranks(std::vector<std::string>& said) {
  return std::erase_if(said, [](const std::string& text) { return text.find("one rank runs") != std::string::npos; }) >
         0;
}

struct Runs {
  std::size_t on_slabs = 0, alone = 0;  // one rank runs all
};

// On two and three ranks, step by step; nothing where the scene cannot be made.
void compare_on_ranks(const std::string& text, Runs& runs) {
  const std::optional<Start> start = start_of(text);
  if (!start) return;
  SCOPED_TRACE(text);
  const auto engine = make_parallel_engine(start->scene, start->state, {1});
  const Trace expected = trace_of(*engine, start->scene.run.t_end, [](const Disks& all) { return state_hash(all); });
  const auto make = start->scene.run.method == Method::exact ? make_slab_exact : make_slab_pairwise;
  for (const int count : {2, 3}) {
    std::vector<Trace> traces(static_cast<std::size_t>(count));
    run_on_local_ranks(count, [&](Ranks& ranks) {
      const auto part = make(start->scene, start->state, {2, 512}, ranks);
      traces[static_cast<std::size_t>(ranks.rank())] = trace_of(
          *part, start->scene.run.t_end, [&](const Disks& own) { return test::state_hash_over_ranks(ranks, own); });
    });
    for (Trace& trace : traces) {
      SCOPED_TRACE(count);
      (leave_out_ranks(trace.said) ? runs.alone : runs.on_slabs) += 1;
      EXPECT_EQ(trace.hashes, expected.hashes);
      EXPECT_EQ(trace.said, expected.said);
    }
  }
}

class SlabScenes : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(SlabScenes, HaveTheBitsOfOneMachine) {
  Runs runs;
  for (std::uint32_t k = 0; k < scenes_a_shard; ++k) {
    compare_on_ranks(fuzz::random_scene(seed, GetParam() * scenes_a_shard + k, 0), runs);
  }
  EXPECT_GE(runs.on_slabs, 10U);
  EXPECT_GE(runs.alone, 10U);
}

TEST_P(SlabScenes, OfOtherKindsHaveThemToo) {
  Runs runs;
  for (std::uint32_t k = 0; k < wide_a_shard; ++k) {
    compare_on_ranks(fuzz::wide_scene(seed, GetParam() * wide_a_shard + k, 0), runs);
  }
  EXPECT_GE(runs.on_slabs, 10U);
}

INSTANTIATE_TEST_SUITE_P(Shards, SlabScenes, ::testing::Range(0U, shards));

}  // namespace
}  // namespace carom
