// Compares runs of `pairwise` on ranks of any kind with runs on one machine.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/ranks/message.hpp"
#include "parallel/ranks/ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "parallel/threads/executor.hpp"
#include "tests/support/feature_scenes.hpp"
#include "tests/support/hash_over_ranks.hpp"
#include "tests/support/same_counters.hpp"

namespace carom::test {

// The results of a run that must not depend on ranks and threads.
struct SlabTrace {
  std::vector<std::uint64_t> hashes;  // after every step
  std::vector<std::size_t> contacts;  // number of contacts after every step
  Counters counters;
  SinkCounts taken;
  WorstOverlap worst_disks, worst_wall;
  std::vector<std::string> warnings;
  std::size_t most_moved = 0;  // on ranks: the most disks that entered or left a rank in a step
  std::size_t most_disks = 0;  // the most disks of a rank after a step
  std::size_t last_disks = 0;  // disks of the rank at the end
  std::size_t thin = 0;        // number of warnings that slabs would be too thin, or that one rank runs all disks
};

// What the engine has come to at the end of the run.
inline void see_end(Engine& engine, SlabTrace& trace) {
  const State& state = engine.state();
  trace.counters = state.counters;
  trace.taken = state.taken;
  trace.worst_disks = state.validity.disks;
  trace.worst_wall = state.validity.wall;
  trace.warnings = engine.take_warnings();
}

inline SlabTrace one_machine_trace(const Scene& scene, const State& start) {
  SlabTrace trace;
  const auto engine = make_parallel_engine(scene, start, {1});
  while (engine->state().time < scene.run.t_end) {
    engine->step();
    trace.hashes.push_back(state_hash(engine->state().disks));
    trace.contacts.push_back(engine->contacts().size());
  }
  see_end(*engine, trace);
  return trace;
}

inline SlabTrace slab_trace(const Scene& scene, const State& start, const Threads& threads, Ranks& ranks) {
  SlabTrace trace;
  const auto make = scene.run.method == Method::exact ? make_slab_exact : make_slab_pairwise;
  const auto engine = make(scene, start, threads, ranks);
  while (engine->state().time < scene.run.t_end) {
    const std::size_t before = engine->state().disks.size();
    engine->step();
    trace.hashes.push_back(state_hash_over_ranks(ranks, engine->state().disks));
    auto contacts = static_cast<std::int64_t>(engine->contacts().size());
    ranks.sum({&contacts, 1});
    trace.contacts.push_back(static_cast<std::size_t>(contacts));
    const std::size_t now = engine->state().disks.size();
    trace.most_disks = std::max(trace.most_disks, now);
    trace.last_disks = now;
    trace.most_moved = std::max(trace.most_moved, std::max(before, now) - std::min(before, now));
  }
  see_end(*engine, trace);
  trace.thin = std::erase_if(trace.warnings, [](const std::string& warning) {
    return warning.find("slabs are too thin") != std::string::npos || warning.find("one rank runs all disks") == 0;
  });
  return trace;
}

inline void expect_same(const WorstOverlap& expected, const WorstOverlap& worst) {
  EXPECT_EQ(expected.overlap.size, worst.overlap.size);
  EXPECT_EQ(expected.overlap.id1, worst.overlap.id1);
  EXPECT_EQ(expected.overlap.id2, worst.overlap.id2);
  EXPECT_EQ(expected.time, worst.time);
}

inline void expect_same(const SlabTrace& expected, const SlabTrace& trace) {
  ASSERT_EQ(expected.hashes.size(), trace.hashes.size());
  for (std::size_t k = 0; k < trace.hashes.size(); ++k) {
    ASSERT_EQ(expected.hashes[k], trace.hashes[k]) << "after step " << k + 1;
  }
  EXPECT_EQ(expected.contacts, trace.contacts);
  EXPECT_EQ(expected.warnings, trace.warnings);
  expect_same(expected.worst_disks, trace.worst_disks);
  expect_same(expected.worst_wall, trace.worst_wall);
  expect_same_counters(expected.counters, trace.counters);
  EXPECT_EQ(expected.taken, trace.taken);
  EXPECT_EQ(all_taken(trace.taken), trace.counters.removed);
}

// The scenes with all combinations of what slabs can have, for one kind of sides. Under gravity disks settle, or, in
// others, nothing dissipates.
inline std::vector<Scene> slab_scenes(const std::string& sides, int steps) {
  std::vector<Scene> all;
  const auto add = [&](const Features& f) {
    all.push_back(feature_scene(f, steps));
    if (!f.gravity || f.restitution < 1.0 || sides == "soft") return;
    all.push_back(all.back());
    all.back().box.restitutions = {1.0, 1.0, 1.0, 1.0};
  };
  for (const Features& f : all_features("pairwise", sides)) {
    // Every other combination of radii and masses of Brownian disks: they take as long as all else.
    const bool brownian = !f.diffusion.empty();
    // With sources that take as much room as all else: every other combination with masses.
    if (f.radii == "wide" || ((brownian || f.source) && f.own_masses)) continue;
    add(f);
  }
  Features tilted;
  tilted.sides = sides;
  tilted.radii = "mixed";
  tilted.own_masses = tilted.gravity = tilted.tilted = true;
  add(tilted);
  for (const char* law : {"viscoelastic", "pairs"}) {
    Features f;
    f.sides = sides;
    f.radii = "mixed";
    f.law = law;
    add(f);
  }
  // Sheared boxes: the image above a border is displaced and moves.
  for (const double shear : {0.4, -1.5}) {
    for (const double restitution : {1.0, 0.8}) {
      for (const char* radii : {"equal", "mixed"}) {
        if (sides != "periodic") continue;
        Features f;
        f.sides = sides;
        f.radii = radii;
        f.shear = shear;
        f.restitution = restitution;
        f.own_masses = f.radii == "mixed";
        add(f);
      }
    }
  }
  // Obstacles, sinks among them, and what else is not in all_features.
  for (const char* rough : {"", "sticking", "sliding"}) {
    for (const char* thermostat : {"", "langevin", "andersen"}) {
      Features f;
      f.sides = sides;
      f.radii = "mixed";
      f.rough = rough;
      f.thermostat = thermostat;
      f.obstacles = f.rough != "sticking";
      f.restitution = 0.7;
      add(f);
    }
  }
  return all;
}

// The trace of rank 0, with which those of all other ranks are compared.
inline SlabTrace local_trace(const Scene& scene, const State& start, const Threads& threads, int count) {
  std::mutex mutex;
  std::vector<SlabTrace> traces(static_cast<std::size_t>(count));
  run_on_local_ranks(count, [&](Ranks& ranks) {
    SlabTrace trace = slab_trace(scene, start, threads, ranks);
    const std::lock_guard lock(mutex);
    traces[static_cast<std::size_t>(ranks.rank())] = std::move(trace);
  });
  for (const SlabTrace& trace : traces) expect_same(traces[0], trace);
  return traces[0];
}

// The trace of one machine, and that slabs have it, on so many ranks with 1 and 2 threads each; or, where they
// alternate, with two threads on odd numbers of ranks.
enum class RankThreads : std::uint8_t { both, alternate };
// on_ranks: sees the trace of each.
inline SlabTrace expect_bits(const Scene& scene, const std::vector<int>& counts, RankThreads choice = RankThreads::both,
                             const std::function<void(const SlabTrace&)>& on_ranks = {}) {
  const State start = initial_state(scene);
  const SlabTrace expected = one_machine_trace(scene, start);
  for (const int ranks : counts) {
    for (const int threads : {1, 2}) {
      // Which makes everything ten times as long, and sees races with the most ranks and threads best.
      if (under_thread_sanitizer && (threads == 1 || ranks != counts.back())) continue;
      const bool in_turn = choice == RankThreads::alternate && !under_thread_sanitizer;
      if (in_turn && threads != 1 + ranks % 2) continue;
      SCOPED_TRACE(fmt::format("{} ranks, {} threads", ranks, threads));
      const SlabTrace trace = local_trace(scene, start, {threads, 512}, ranks);
      expect_same(expected, trace);
      if (on_ranks) on_ranks(trace);
    }
  }
  return expected;
}

// A group of disks, without its header, for a box 24 wide and 16 high: 30 columns of three, of which the heavy outer
// ones close in on the light one between them, which is sent far.
inline std::string light_between_heavy(const std::string& light_mass) {
  std::string places;
  std::string velocities;
  std::string masses;
  for (int k = 0; k < 30; ++k) {
    const double x = 1.0 + 2.0 * (k % 10) + 0.3 * (k / 10);
    const double y = 2.0 + 4.0 * (k / 10) + 0.3 * (k % 3);
    places += fmt::format("[{0}, {1}], [{0}, {2}], [{0}, {3}], ", x, y, y + 1.01, y + 2.02);
    velocities += fmt::format("[0.0, 2.4], [0.0{}, 0.1], [0.0, -2.4], ", k);
    masses += "1.0, " + light_mass + ", 1.0, ";
  }
  return "count = 90\npositions = [" + places + "]\nvelocities = [" + velocities + "]\nradius = 0.5\nmass = [" +
         masses + "]\n";
}

inline Scene slab_scene(const std::string& sides, const std::string& box, const std::string& disks, double dt,
                        int count) {
  return parse_scene("[box]\n" + sides_text(sides, 1) + box + "[[disks]]\n" + disks +
                         fmt::format("[run]\nmethod = \"pairwise\"\ndt = {}\nt_end = {}\n", dt, dt * count),
                     "scene", "");
}

}  // namespace carom::test
