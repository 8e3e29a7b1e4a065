// The whole step of scene G over disks and threads, beside the copy limit of the same threads. The label of a row is
// the hash of the state after its fixed number of steps: rows of one size must agree for any number of threads and any
// order of storage.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <memory>

#include "bench/support/bench_scenes.hpp"
#include "bench/support/copy_limit.hpp"
#include "bench/support/shield.hpp"
#include "core/disks/state_hash.hpp"
#include "core/step/engine.hpp"
#include "parallel/simulation.hpp"

namespace carom::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Disk-steps in a row, about a second of work; at least 20 steps, which include a few sorts.
constexpr double row_work = 2e7;

const Start& gas_of(std::size_t disks) {
  static std::map<std::size_t, Start> made;
  const auto [it, fresh] = made.try_emplace(disks);
  if (fresh) it->second = gas(disks);
  return it->second;
}

benchmark::IterationCount steps_for(std::size_t disks) {
  return std::max<benchmark::IterationCount>(
      20, static_cast<benchmark::IterationCount>(row_work / static_cast<double>(disks)));
}

template <class Work>
void time_each(benchmark::State& row, std::size_t disks, Work&& work) {
  const Shield shield;
  for (auto _ : row) {
    const auto start = Clock::now();
    work();
    row.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  row.SetItemsProcessed(row.iterations() * static_cast<std::int64_t>(disks));
}

void step_row(benchmark::State& row, std::size_t disks, int threads) {
  const Start& start = gas_of(disks);
  const auto engine = make_parallel_engine(start.scene, start.state, {threads});
  for (int k = 0; k < 10; ++k) engine->step();  // warms up
  time_each(row, disks, [&] { engine->step(); });
  row.SetLabel(hash_text(state_hash(engine->state().disks)));
}

// The order of storage matters only until the first sort: this is that one step, from disks stored in random order.
void first_step_row(benchmark::State& row, std::size_t disks, int threads, bool shuffle) {
  const Start& start = gas_of(disks);
  const State state = shuffle ? shuffled(start.state) : start.state;
  std::unique_ptr<Engine> engine;
  for (auto _ : row) {
    engine = make_parallel_engine(start.scene, state, {threads});
    const Shield shield;
    const auto begin = Clock::now();
    engine->step();
    row.SetIterationTime(std::chrono::duration<double>(Clock::now() - begin).count());
  }
  row.SetItemsProcessed(row.iterations() * static_cast<std::int64_t>(disks));
  row.SetLabel(hash_text(state_hash(engine->state().disks)));
}

void copy_row(benchmark::State& row, std::size_t disks, int threads) {
  CopyLimit columns(disks);
  const Executor executor(threads);
  columns.copy(executor);
  time_each(row, disks, [&] { columns.copy(executor); });
  row.SetBytesProcessed(row.iterations() * static_cast<std::int64_t>(64 * disks));
}

// items_per_second is disk-steps per second.
[[maybe_unused]] const bool rows_registered = [] {
  for (const std::size_t disks : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
    for (const int threads : {1, 2}) {
      const auto add = [&](const char* what, auto function, benchmark::IterationCount steps) {
        benchmark::RegisterBenchmark(fmt::format("{}/disks:{}/threads:{}", what, disks, threads).c_str(), function)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(steps);
      };
      add(
          "step", [=](benchmark::State& row) { step_row(row, disks, threads); }, steps_for(disks));
      add(
          "first_step_sorted", [=](benchmark::State& row) { first_step_row(row, disks, threads, false); }, 2);
      add(
          "first_step_shuffled", [=](benchmark::State& row) { first_step_row(row, disks, threads, true); }, 2);
      add(
          "copy_limit", [=](benchmark::State& row) { copy_row(row, disks, threads); }, steps_for(disks));
    }
  }
  return true;
}();

}  // namespace
}  // namespace carom::bench
