#include "run/make_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/input_message.hpp"
#include "core/start/initial_state.hpp"
#include "parallel/pair_counting.hpp"
#include "parallel/simulation.hpp"
#include "parallel/start/random_placement.hpp"

namespace carom {

EngineChoice choose_engine(const std::string& engine, std::optional<int> threads) {
  constexpr std::array<std::string_view, 2> engines{"parallel", "reference"};
  if (engine.empty() || engine == "parallel") {
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    return {"parallel", threads.value_or(cores)};
  }
  if (engine != "reference") {
    fail_input("--engine", fmt::format("there is no engine {}", in_quotes(engine)), expected_one_of(engines, engine));
  }
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
  return initial_state(scene, place_at_random, growth);
}

BlockRunner make_block_runner(const EngineChoice& choice) {
  const auto executor = std::make_shared<Executor>(choice.threads);
  return
      [executor](std::size_t blocks, const BlockTask& task) { executor->run(blocks, [&](std::size_t b) { task(b); }); };
}

std::unique_ptr<Engine> make_engine(const EngineChoice& choice, const Scene& scene, State initial) {
  if (choice.name == "reference") return make_reference_engine(scene, std::move(initial));
  return make_parallel_engine(scene, std::move(initial), {choice.threads});
}

PairCounter make_pair_counter(const EngineChoice& choice) {
  if (choice.name == "reference") return count_pairs;
  return parallel_pair_counter(choice.threads);
}

}  // namespace carom
