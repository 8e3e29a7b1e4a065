#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/disks/state_hash.hpp"
#include "core/load/scene_file.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/ranks/local_ranks.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/slab_exact.hpp"
#include "parallel/slabs/slab_pairwise.hpp"
#include "tests/fuzz_scenes/trial.hpp"
#include "tests/support/hash_over_ranks.hpp"

namespace carom::fuzz {

namespace {

constexpr int steps = 15;

struct RankTrace {
  std::vector<std::uint64_t> hashes;  // after every step
  std::vector<std::string> said;      // warnings, and the error that ended the run
  bool alone = false;                 // one rank runs all disks
};

template <class Hash>
RankTrace trace_of(Engine& engine, double t_end, Hash&& hash) {
  RankTrace trace;
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
  trace.alone = std::erase_if(trace.said, [](const std::string& text) {
                  return text.find("one rank runs") != std::string::npos;
                }) > 0;
  return trace;
}

std::vector<RankTrace> run_on_ranks(const Scene& scene, const State& start, int count) {
  const auto make = scene.run.method == Method::exact ? make_slab_exact : make_slab_pairwise;
  std::vector<RankTrace> traces(static_cast<std::size_t>(count));
  run_on_local_ranks(count, [&](Ranks& ranks) {
    const auto part = make(scene, start, {2, 512}, ranks);
    traces[static_cast<std::size_t>(ranks.rank())] =
        trace_of(*part, scene.run.t_end, [&](const Disks& own) { return test::state_hash_over_ranks(ranks, own); });
  });
  return traces;
}

std::string difference(const RankTrace& expected, const RankTrace& found) {
  if (found.hashes != expected.hashes) {
    const auto [at, other] =
        std::mismatch(expected.hashes.begin(), expected.hashes.end(), found.hashes.begin(), found.hashes.end());
    return fmt::format("other disks after step {}, of {} instead of {}", at - expected.hashes.begin() + 1,
                       found.hashes.size(), expected.hashes.size());
  }
  if (found.said == expected.said) return "";
  return fmt::format("says [{}] instead of [{}]", fmt::join(found.said, "; "), fmt::join(expected.said, "; "));
}

}  // namespace

RankTrial try_on_ranks(const std::string& text, const std::string& name, const std::string& folder) {
  RankTrial trial;
  Scene scene;
  State start;
  try {
    scene = parse_scene(text, name, folder);
    start = initial_state(scene);
  } catch (const InputError& error) {
    trial.refusal = error.what();
    return trial;
  }
  if (scene.run.method == Method::rollback) {
    trial.refusal = "cannot run on several ranks";
    return trial;
  }
  const auto engine = make_parallel_engine(scene, start, {1});
  const RankTrace expected = trace_of(*engine, scene.run.t_end, [](const Disks& all) { return state_hash(all); });
  for (const int count : {2, 3}) {
    const std::vector<RankTrace> traces = run_on_ranks(scene, start, count);
    for (std::size_t rank = 0; rank < traces.size(); ++rank) {
      const std::string what = difference(expected, traces[rank]);
      if (!what.empty()) trial.faults.push_back(fmt::format("rank {} of {}: {}", rank, count, what));
      (traces[rank].alone ? trial.alone : trial.on_slabs) += 1;
    }
  }
  trial.account = fmt::format("{} slabs, {} ranks of runs that one of them runs", trial.on_slabs, trial.alone);
  return trial;
}

}  // namespace carom::fuzz
