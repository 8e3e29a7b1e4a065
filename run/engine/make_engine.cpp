#include "run/engine/make_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/input_message.hpp"
#include "core/load/scene_file.hpp"
#include "core/scene/scene_text.hpp"
#include "core/start/initial_state.hpp"
#include "io/checkpoint/checkpoint.hpp"
#include "parallel/simulation.hpp"
#include "parallel/slabs/leading_engine.hpp"
#include "parallel/start/random_placement.hpp"

namespace carom {

namespace {

// The text that read_rank_start reads.
std::string rank_start(const Scene& scene, const State& state) {
  RunRecord record;
  record.scene_text = resolved_toml(scene);
  return checkpoint_bytes(record, state);
}

}  // namespace

int threads_of_rank(int ranks) {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks);
}

int ranks_of(const RankLead& lead) {
  return lead.count();
}

EngineChoice choose_engine(const std::string& engine, std::optional<int> threads, RankLead* lead) {
  constexpr std::array<std::string_view, 2> engines{"parallel", "reference"};
  if (engine.empty() || engine == "parallel") {
    const int ranks = lead != nullptr ? lead->count() : 1;
    return {"parallel", threads.value_or(threads_of_rank(ranks)), ranks, lead};
  }
  if (engine != "reference") {
    fail_input("--engine", fmt::format("there is no engine {}", in_quotes(engine)), expected_one_of(engines, engine));
  }
  if (lead != nullptr) fail_input("--ranks", "the reference engine runs on one rank", "expected --engine parallel");
  return {"reference", 1};
}

void fail_memory(const Scene& scene) {
  Count disks = 0;
  for (const DiskGroup& group : scene.groups) disks += group.count;
  fail_input(fmt::format("{}: disks", scene.file),
             fmt::format("{} disks do not fit into the memory that this process may use", disks),
             "expected fewer disks");
}

State make_initial_state(const EngineChoice& choice, const Scene& scene,
                         const std::function<void(const GrowthProgress&)>& watch) {
  if (choice.name != "reference") return parallel_initial_state(scene, choice.threads, watch);
  GrowthTools growth = plain_growth();
  growth.watch = watch;
  const PlaceAtRandom place = place_watched([&] {
    if (watch) watch({});
  });
  return initial_state(scene, place, growth);
}

std::pair<Scene, State> read_rank_start(const std::string& start) {
  Checkpoint checkpoint = checkpoint_from_bytes(start, "the state of rank 0");
  return {parse_scene(checkpoint.record.scene_text, "the scene of rank 0", ""), std::move(checkpoint.state)};
}

BlockRunner make_block_runner(const EngineChoice& choice) {
  return choice.name == "reference" ? BlockRunner(run_in_order) : blocks_on_threads(choice.threads);
}

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial) {
  if (choice.lead != nullptr) {
    const auto start = [&](const State& state) { return rank_start(scene, state); };
    return choice.lead->make_engine(scene, std::move(initial), {choice.threads}, start);
  }
  if (choice.name == "reference") return make_reference_engine(scene, std::move(initial));
  return make_parallel_engine(scene, std::move(initial), {choice.threads});
}

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial,
                                    std::unique_ptr<DiskSource> disks) {
  const auto start = [&](const State& state) { return rank_start(scene, state); };
  return choice.lead->make_engine(scene, std::move(initial), std::move(disks), {choice.threads}, start);
}

std::unique_ptr<Engine> make_engine_at_start(const EngineChoice& choice, const Scene& scene,
                                             const std::function<void(const GrowthProgress&)>& watch) {
  if (choice.lead != nullptr) {
    const auto start = [&](const State& state) { return rank_start(scene, state); };
    std::unique_ptr<Engine> engine = choice.lead->make_engine_at_start(scene, {choice.threads}, start);
    if (engine) return engine;
  }
  return make_engine(choice, scene, make_initial_state(choice, scene, watch));
}

}  // namespace carom
