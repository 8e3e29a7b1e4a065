// Runs of `pairwise` on ranks of any kind, held against one machine.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/rank_sums.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "tests/support/feature_scenes.hpp"

namespace carom::test {

// What of a run must not depend on ranks and threads.
struct SlabTrace {
  std::vector<std::uint64_t> hashes;  // after every step
  std::vector<std::size_t> contacts;  // likewise, their number
  Counters counters;
  std::vector<std::string> warnings;
  std::size_t most_moved = 0;  // on ranks: the most disks that came to a rank, or left it, in a step
};

inline SlabTrace one_machine_trace(const Scene& scene, const State& start) {
  SlabTrace trace;
  const auto engine = make_parallel_engine(scene, start, {1});
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    trace.hashes.push_back(state_hash(engine->state().disks));
    trace.contacts.push_back(engine->contacts().size());
  }
  trace.counters = engine->state().counters;
  trace.warnings = engine->take_warnings();
  return trace;
}

inline SlabTrace slab_trace(const Scene& scene, const State& start, const Threads& threads, Ranks& ranks) {
  SlabTrace trace;
  const auto engine = make_slab_pairwise(scene, start, threads, ranks);
  while (engine->state().time < scene.run.t_end) {
    const std::size_t before = engine->state().disks.size();
    engine->step();
    trace.hashes.push_back(state_hash_over_ranks(ranks, engine->state().disks));
    auto contacts = static_cast<std::int64_t>(engine->contacts().size());
    ranks.sum({&contacts, 1});
    trace.contacts.push_back(static_cast<std::size_t>(contacts));
    const std::size_t now = engine->state().disks.size();
    trace.most_moved = std::max(trace.most_moved, std::max(before, now) - std::min(before, now));
  }
  trace.counters = engine->state().counters;
  trace.warnings = engine->take_warnings();
  return trace;
}

inline void expect_same(const SlabTrace& expected, const SlabTrace& trace) {
  ASSERT_EQ(expected.hashes, trace.hashes);
  EXPECT_EQ(expected.contacts, trace.contacts);
  EXPECT_EQ(expected.warnings, trace.warnings);
  EXPECT_EQ(expected.counters.steps, trace.counters.steps);
  EXPECT_EQ(expected.counters.collisions, trace.counters.collisions);
  EXPECT_EQ(expected.counters.wall_collisions, trace.counters.wall_collisions);
  EXPECT_EQ(expected.counters.virial, trace.counters.virial);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(expected.counters.wall_impulse[k], trace.counters.wall_impulse[k]);
}

// The scenes with all combinations of what slabs can have, for one kind of sides. Under gravity nothing dissipates.
inline std::vector<Scene> slab_scenes(const std::string& sides, int steps) {
  std::vector<Scene> all;
  for (const Features& f : all_features("pairwise", sides)) {
    const bool dissipates = f.restitution < 1.0 || sides == "soft";
    if ((f.gravity && dissipates) || !f.diffusion.empty() || f.source || f.radii == "wide") continue;
    all.push_back(feature_scene(f, steps));
    if (f.gravity) all.back().box.restitutions = {1.0, 1.0, 1.0, 1.0};
  }
  Features tilted;
  tilted.sides = sides;
  tilted.radii = "mixed";
  tilted.own_masses = tilted.gravity = tilted.tilted = true;
  all.push_back(feature_scene(tilted, steps));
  all.back().box.restitutions = {1.0, 1.0, 1.0, 1.0};
  for (const char* law : {"viscoelastic", "pairs"}) {
    Features f;
    f.sides = sides;
    f.radii = "mixed";
    f.law = law;
    all.push_back(feature_scene(f, steps));
  }
  return all;
}

}  // namespace carom::test
